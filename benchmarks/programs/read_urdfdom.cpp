// URDF by urdfdom, the parser of ROS.
#include <urdf_parser/urdf_parser.h>

#include <cstdlib>
#include <string>

#include "turns.hh"

int main(int count, char **arguments) {
  return turns::serve(count > 1 ? std::atof(arguments[1]) : 0, [](const std::string &path) {
    return std::string(urdf::parseURDFFile(path) ? "" : "it is not read");
  });
}
