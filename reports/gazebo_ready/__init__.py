"""Is nothing refused, frozen, dropped or ended with that was converted for Gazebo?"""
