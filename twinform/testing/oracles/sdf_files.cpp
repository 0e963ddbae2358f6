// Loads a file with libsdformat 12, and asks the library where each mesh and texture is that its models name: one JSON
// object per line, with the URI and the path, which is empty where it finds nothing. The errors of loading come first.
#include <iostream>
#include <sdf/sdf.hh>
#include <string>

#include "headers/json.hh"

namespace {

void find(const std::string &uri) {
  if (uri.empty()) return;
  std::cout << "{\"uri\": " << json::quoted(uri) << ", \"path\": " << json::quoted(sdf::findFile(uri)) << "}\n";
}

void find_in(const sdf::Geometry *geometry) {
  if (geometry != nullptr && geometry->MeshShape() != nullptr) find(geometry->MeshShape()->Uri());
  if (geometry != nullptr && geometry->HeightmapShape() != nullptr) find(geometry->HeightmapShape()->Uri());
}

void find_in(const sdf::Material *material) {
  if (material == nullptr) return;
  find(material->ScriptUri());
  const sdf::Pbr *pbr = material->PbrMaterial();
  const sdf::PbrWorkflow *metal = pbr == nullptr ? nullptr : pbr->Workflow(sdf::PbrWorkflowType::METAL);
  if (metal != nullptr) find(metal->AlbedoMap());
}

void find_in(const sdf::Model &model) {
  for (uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link &link = *model.LinkByIndex(i);
    for (uint64_t k = 0; k < link.VisualCount(); ++k) {
      find_in(link.VisualByIndex(k)->Geom());
      find_in(link.VisualByIndex(k)->Material());
    }
    for (uint64_t k = 0; k < link.CollisionCount(); ++k) find_in(link.CollisionByIndex(k)->Geom());
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i) find_in(*model.ModelByIndex(i));
}

}  // namespace

int main(int, char **arguments) {
  sdf::Root root;
  for (const sdf::Error &error : root.Load(arguments[1])) {
    std::cout << "{\"error\": " << json::quoted(error.Message()) << "}\n";
  }
  if (root.Model() != nullptr) find_in(*root.Model());
  for (uint64_t i = 0; i < root.WorldCount(); ++i) {
    const sdf::World &world = *root.WorldByIndex(i);
    for (uint64_t k = 0; k < world.ModelCount(); ++k) find_in(*world.ModelByIndex(k));
  }
  return 0;
}
