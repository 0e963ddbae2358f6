"""Migration from Gazebo Classic to gz-sim."""
