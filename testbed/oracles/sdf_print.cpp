// Prints a file as libsdformat 12 understands it: URDF becomes SDF, with fixed joints lumped.
#include <iostream>
#include <sdf/sdf.hh>

int main(int count, char **arguments) {
  if (count != 2) return 2;
  sdf::SDFPtr document(new sdf::SDF());
  sdf::init(document);
  sdf::Errors errors;
  if (!sdf::readFile(arguments[1], document, errors)) return 1;
  std::cout << document->Root()->ToString("");
  return 0;
}
