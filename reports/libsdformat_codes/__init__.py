"""Which rules find what libsdformat finds, and which find what it does not?"""
