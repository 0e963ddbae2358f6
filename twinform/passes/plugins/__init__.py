"""Gazebo plugins and sensors: the catalog, adding them to models, and checking them."""
