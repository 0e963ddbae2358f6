"""Are the comments of real files still there, whatever is done with the files?"""
