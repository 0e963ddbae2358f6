"""How many small faults do the tests notice? A sample of each room, by mutmut."""
