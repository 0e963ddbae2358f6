"""Packages for ROS 2 before judges that are not us: catkin, CMake, launch, YAML, XML, shells, ROS itself."""
