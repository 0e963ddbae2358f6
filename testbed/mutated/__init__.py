"""Files of the corpus with mistakes, and the verdicts of the parsers of record on them."""
