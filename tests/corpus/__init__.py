"""Claims about real models that nobody on this project wrote."""
