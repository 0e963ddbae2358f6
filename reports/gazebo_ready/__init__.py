"""Is anything left that Gazebo refuses, freezes, drops or ends with after `convert --for gazebo`?"""
