"""Are packaged robots complete, and the same robots, to the programs that read packages?"""
