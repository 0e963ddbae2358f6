"""Are planted mistakes found at the piece that is wrong, and what is reported about models that others accept?"""
