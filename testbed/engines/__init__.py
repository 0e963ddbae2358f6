"""Programs that judge what we write and need more than a wheel: Gazebo's physics, and nine loaders of models."""
