"""Do worlds and packages hold?"""

SECTIONS = {
    "worlds": "Worlds taken apart",
    "packages": "Packages of robots with meshes",
    "ros2_packages": "Packages of ROS 2 of robots with meshes",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
