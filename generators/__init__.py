"""Makes pages, tables and pictures for the documents from what the case files show."""
