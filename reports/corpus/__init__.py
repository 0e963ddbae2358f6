"""What does the compiler make of every real file, and what does not come back?"""
