// Reads URDF files with DART's own reader and reports what it keeps of each, one JSON object per line.
// Messages go to standard error as the library writes them; file names are the arguments. The object is empty where
// the library refuses the file.
#include <dart/dart.hpp>
#include <dart/utils/urdf/urdf.hpp>

#include <iostream>
#include <string>
#include <vector>

#include "../headers/json.hh"

namespace {

std::string described(const dart::dynamics::Skeleton &robot) {
  std::vector<std::string> links, joints, masses;
  size_t shapes = 0;
  for (size_t i = 0; i < robot.getNumBodyNodes(); ++i) {
    const auto *body = robot.getBodyNode(i);
    links.push_back(json::quoted(body->getName()));
    masses.push_back("[" + json::quoted(body->getName()) + ", " + json::number(body->getMass()) + "]");
    shapes += body->getNumShapeNodes();
    // a root that nothing holds has a joint that is not in the file
    if (body->getParentBodyNode()) joints.push_back(json::quoted(body->getParentJoint()->getName()));
  }
  return json::object({json::member("links", json::list(links)), json::member("joints", json::list(joints)),
                       json::member("masses", json::list(masses)),
                       json::member("shapes", std::to_string(shapes))});
}

}  // namespace

int main(int count, char **arguments) {
  for (int i = 1; i < count; ++i) {
    dart::utils::DartLoader loader;
    const auto robot = loader.parseSkeleton(arguments[i]);
    std::cout << (robot ? described(*robot) : "{}") << std::endl;
  }
  return 0;
}
