"""Is it the same robot to Drake and other engines, libsdformat and urdfdom?"""
