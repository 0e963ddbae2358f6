"""Is it the same robot in Gazebo's own physics, DART and Bullet?"""
