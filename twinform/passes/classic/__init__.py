"""From Gazebo Classic to gz-sim."""
