"""How many models an hour does a batch work on, what survives being killed, and what would a million take?"""
