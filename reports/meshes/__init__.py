"""Are meshes that passes have changed as near to the old ones as was asked for, and how much cheaper are they?"""
