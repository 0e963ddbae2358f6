"""Does every SDF file survive older versions, and is it the same robot to Drake?"""
