"""Is every xacro file expanded to what the xacro command makes of it?"""
