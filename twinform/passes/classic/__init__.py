"""Migration of models and worlds from Gazebo Classic to gz-sim."""
