// Reads URDF files with urdfdom and reports what it keeps of each, one JSON object per line.
// Messages go to standard error as the library writes them; file names are the arguments. The object is empty where
// the library refuses the file.
#include <urdf_parser/urdf_parser.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "../../../twinform/testing/oracles/headers/json.hh"

namespace {

std::string content(const char *path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string described(const urdf::ModelInterface &model) {
  std::vector<std::string> links, joints, masses;
  size_t shapes = 0;
  for (const auto &[name, link] : model.links_) {
    links.push_back(json::quoted(name));
    if (link->inertial) masses.push_back("[" + json::quoted(name) + ", " + json::number(link->inertial->mass) + "]");
    shapes += link->visual_array.size() + link->collision_array.size();
  }
  for (const auto &[name, joint] : model.joints_) joints.push_back(json::quoted(name));
  return json::object({json::member("links", json::list(links)), json::member("joints", json::list(joints)),
                       json::member("masses", json::list(masses)),
                       json::member("shapes", std::to_string(shapes))});
}

}  // namespace

int main(int count, char **arguments) {
  for (int i = 1; i < count; ++i) {
    // urdfdom throws out of some broken values: whoever calls it then ends
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(content(arguments[i]));
    std::cout << (model ? described(*model) : "{}") << std::endl;
  }
  return 0;
}
