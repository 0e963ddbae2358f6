"""ROS 2 description packages: `package.xml`, CMake, launch files, RViz, controllers, bridge and world for one robot."""
