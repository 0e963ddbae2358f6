"""Is it the same robot?"""

SECTIONS = {
    "sameness": "Is it still the same robot?",
    "oracle": "The same robot, in the eyes of others",
    "equipment": "What Gazebo finds in our URDF and SDF",
    "gazebo_runs": "Conversions in Gazebo's own physics",
    "contacts": "Contacts",
    "versions": "Versions of SDF",
    "older_urdf": "Versions of URDF",
    "mjcf": "MJCF",
    "mjcf_meshes": "MJCF with meshes",
    "mjcf_packages": "MJCF of published packages",
    "mjcf_in_drake": "MJCF in Drake",
    "mjcf_motion": "MJCF in motion",
}
"""The sections of the page by the names of their modules, each with its title, in the order of the page."""
