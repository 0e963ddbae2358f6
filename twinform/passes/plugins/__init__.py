"""Plugins and sensors of Gazebo: what there is, adding it to models, and checking it."""
