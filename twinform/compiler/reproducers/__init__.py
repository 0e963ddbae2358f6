"""Files that make the fault of a pass come again, for `twinform reproduce`."""
