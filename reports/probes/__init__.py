"""What does libsdformat make of small URDF files, beside what we make of them?"""
