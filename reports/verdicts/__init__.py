"""Where do libsdformat 12 and urdfdom judge mutated files otherwise, and why?"""
