"""Are fixed joints lumped as libsdformat 12 does, and is the motion the same?"""
