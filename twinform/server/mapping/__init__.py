"""Where each element and attribute goes in the other format, by the facts tables of both."""
