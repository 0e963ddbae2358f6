"""Does the other file follow an edit, and nothing else in it change?"""
