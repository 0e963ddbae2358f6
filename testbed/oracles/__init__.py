"""Other parsers of both formats, and comparisons of XML that know nothing of the compiler."""
