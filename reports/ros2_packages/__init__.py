"""Do packages of ROS 2 build, launch and publish the robot, to catkin, CMake, launch files, urdfdom and ROS itself?"""
