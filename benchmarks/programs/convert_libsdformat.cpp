// URDF to SDF by libsdformat 12, as `gz sdf --print` does it: read the description of SDF, read the file, write it.
// After `--once` the description is read once and for all files.
#include <cstdlib>
#include <sdf/sdf.hh>
#include <string>

#include "turns.hh"

namespace {

sdf::SDFPtr description() {
  const sdf::SDFPtr made(new sdf::SDF());
  sdf::init(made);
  return made;
}

std::string converted(const std::string &path, const sdf::SDFPtr &document) {
  sdf::Errors errors;
  const bool is_read = sdf::readFile(path, document, errors);
  if (!errors.empty()) return errors.front().Message();
  return is_read && !document->ToString().empty() ? "" : "it is not read";
}

}  // namespace

int main(int count, char **arguments) {
  const double least = count > 1 ? std::atof(arguments[1]) : 0;
  const bool once = count > 2 && std::string(arguments[2]) == "--once";
  const sdf::SDFPtr kept = description();
  return turns::serve(least, [&](const std::string &path) {
    if (!once) return converted(path, description());
    kept->Root()->ClearElements();
    return converted(path, kept);
  });
}
