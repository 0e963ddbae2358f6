// Files through libsdformat, URDF or SDF.
#pragma once

#include <sdf/sdf.hh>
#include <string>

namespace loading {

// what sdf::Root::Load(path) does, but for reading the description of the format, which takes longer than most files
inline sdf::Errors load(const std::string &path, const sdf::SDFPtr &description, sdf::Root &root) {
  sdf::Errors errors;
  if (!sdf::readFile(path, description, errors)) {
    errors.push_back({sdf::ErrorCode::FILE_READ, "Unable to read file:" + path});
    return errors;
  }
  const sdf::Errors more = root.Load(description);
  errors.insert(errors.end(), more.begin(), more.end());
  return errors;
}

}  // namespace loading
