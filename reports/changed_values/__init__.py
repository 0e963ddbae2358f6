"""Does `twinform diff` see every changed value, and no other spelling?"""
