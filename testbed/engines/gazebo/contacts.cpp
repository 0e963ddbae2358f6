// How deep a ball is in the collisions of URDF and SDF files, as libsdformat 12 and gz-physics 5 give them to DART, with the detector
// that Gazebo uses, ODE. Meshes are those that DART loads itself. Standard input has a line for each file, `FILE|RADIUS|X Y Z;X Y Z;...`,
// with the centers of the ball in the frame of the model. The answer is a list of pairs in m: how deep the ball is, 0 where nothing
// touches, and how large a ball there has to be to touch.
//
//   contacts FOLDER_OF_PLUGINS
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/dynamics/dynamics.hpp>
#include <filesystem>
#include <ignition/common/Console.hh>
#include <iostream>
#include <sstream>

#include "../../../twinform/testing/oracles/headers/loading.hh"
#include "numbers.hh"
#include "scene.hh"

namespace {

namespace physics = ignition::physics;

using dart::dynamics::SimpleFrame;
using dart::dynamics::SphereShape;
using Frames = std::vector<std::shared_ptr<SimpleFrame>>;

std::vector<std::string> split(const std::string &text, const char at) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, at);) out.push_back(word);
  return out;
}

std::shared_ptr<SimpleFrame> frame(const dart::dynamics::ShapePtr &shape, const Eigen::Isometry3d &pose) {
  static unsigned count = 0;
  auto made = std::make_shared<SimpleFrame>(dart::dynamics::Frame::World(), "frame" + std::to_string(count++), pose);
  made->setShape(shape);
  return made;
}

Eigen::Isometry3d resolved(const sdf::SemanticPose &semantic) {
  ignition::math::Pose3d pose;
  if (!semantic.Resolve(pose, "__model__").empty()) throw std::runtime_error("a pose is not resolved");
  return ignition::math::eigen3::convert(pose);
}

// the meshes of a model, which gz-physics leaves to gz-sim
void add_meshes(const sdf::Model &model, const std::string &path, Frames &out) {
  for (uint64_t i = 0; i < model.LinkCount(); ++i) {
    for (uint64_t j = 0; j < model.LinkByIndex(i)->CollisionCount(); ++j) {
      const sdf::Collision &collision = *model.LinkByIndex(i)->CollisionByIndex(j);
      const sdf::Mesh *mesh = collision.Geom()->MeshShape();
      if (mesh == nullptr) continue;
      const auto file = std::filesystem::path(path).parent_path() / mesh->Uri();
      const aiScene *loaded = dart::dynamics::MeshShape::loadMesh(file.string());
      if (loaded == nullptr) throw std::runtime_error("no mesh " + file.string());
      const auto shape = std::make_shared<dart::dynamics::MeshShape>(ignition::math::eigen3::convert(mesh->Scale()), loaded);
      out.push_back(frame(shape, resolved(collision.SemanticPose())));
    }
  }
}

// the shapes of a file, those that gz-physics makes taken out of the world of DART
Frames shapes(const std::string &path, const physics::Engine3dPtr<engine::Dart::Features> &engine) {
  Frames out;
  const sdf::SDFPtr description(new sdf::SDF());
  sdf::init(description);
  sdf::Root root;
  for (const sdf::Error &each : loading::load(path, description, root)) throw std::runtime_error(each.Message());
  scene::Scene<engine::Dart> scene(engine, nullptr);
  scene.add(*root.Model());
  const auto world = scene.world->GetDartsimWorld();
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i) {
    for (auto *body : world->getSkeleton(i)->getBodyNodes()) {
      for (auto *node : body->getShapeNodesWith<dart::dynamics::CollisionAspect>()) {
        out.push_back(frame(node->getShape(), node->getWorldTransform()));
      }
    }
  }
  add_meshes(*root.Model(), path, out);
  return out;
}

double depth(const Frames &shapes, const std::shared_ptr<SimpleFrame> &ball) {
  const auto detector = dart::collision::OdeCollisionDetector::create();
  const auto group = detector->createCollisionGroup(), probe = detector->createCollisionGroup(ball.get());
  for (const auto &shape : shapes) group->addShapeFrame(shape.get());
  dart::collision::CollisionResult result;
  group->collide(probe.get(), dart::collision::CollisionOption(true, 1000), &result);
  double out = 0;
  for (const auto &contact : result.getContacts()) out = std::max(out, contact.penetrationDepth);
  return out;
}

// the radius with which a ball touches, at most that of the question: by bisection, as ODE's depth in a mesh depends on the triangles
double reach(const Frames &shapes, const std::shared_ptr<SimpleFrame> &ball, const double radius) {
  double apart = 0, touching = radius;
  const auto sphere = std::make_shared<SphereShape>(radius);
  ball->setShape(sphere);
  for (int step = 0; step < 48; ++step) {
    const double middle = (apart + touching) / 2;
    sphere->setRadius(middle);
    (depth(shapes, ball) > 0 ? touching : apart) = middle;
  }
  return touching;
}

void answer(const std::vector<std::string> &question, const physics::Engine3dPtr<engine::Dart::Features> &engine) {
  const Frames made = shapes(question.at(0), engine);
  const double radius = std::stod(question.at(1));
  const auto ball = frame(std::make_shared<SphereShape>(radius), Eigen::Isometry3d::Identity());
  std::cout << "[";
  std::string comma;
  for (const std::string &place : split(question.at(2), ';')) {
    Eigen::Vector3d center;
    std::istringstream(place) >> center.x() >> center.y() >> center.z();
    ball->setTranslation(center);
    ball->setShape(std::make_shared<SphereShape>(radius));
    std::cout << comma << "[" << json::number(depth(made, ball)) << ", " << json::number(reach(made, ball, radius)) << "]";
    comma = ", ";
  }
  std::cout << "]" << std::endl;
}

}  // namespace

int main(int, char **arguments) {
  ignition::common::Console::SetVerbosity(1);
  const auto engine = engine::load<engine::Dart>(arguments[1]);
  for (std::string line; std::getline(std::cin, line);) answer(split(line, '|'), engine);
}
