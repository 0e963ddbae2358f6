// A world in an engine, built part by part as gz-sim's physics system does: poses, axes and names of links are resolved by
// libsdformat first, and the engine sees no frames. Collisions with meshes and heightmaps, which gz-sim reads itself, are left out.
#pragma once

#include <dart/simulation/World.hpp>
#include <ignition/math/eigen3/Conversions.hh>
#include <map>
#include <sdf/sdf.hh>

#include "../../../twinform/testing/oracles/headers/child.hh"
#include "engine.hh"

namespace scene {

namespace physics = ignition::physics;
using ignition::math::Pose3d;

template <typename Kind>
struct Link {
  std::string name;  // with the names of its models before it
  physics::Link3dPtr<typename Kind::Features> made;
  dart::dynamics::BodyNode *body = nullptr;
};

template <typename Kind>
struct Joint {
  std::string name;
  sdf::JointType kind;
  std::string parent, child;
  physics::Joint3dPtr<typename Kind::Features> made;  // none where the engine refused it
  dart::dynamics::Joint *body = nullptr;
};

template <typename Kind>
class Scene {
 public:
  using Features = typename Kind::Features;
  using ModelPtr = physics::Model3dPtr<Features>;

  physics::World3dPtr<Features> world;
  std::vector<Link<Kind>> links;
  std::vector<Joint<Kind>> joints;
  std::vector<std::string> left_out;  // what was not given to the engine

  Scene(const physics::Engine3dPtr<Features> &engine, const sdf::World *given) {
    sdf::World empty;
    empty.SetName(given == nullptr ? "default" : given->Name());
    if (given != nullptr) empty.SetGravity(given->Gravity());
    world = engine->ConstructWorld(empty);
  }

  void add(const sdf::Model &model) { finish(model, world->ConstructModel(bare(model)), model.Name()); }

 private:
  std::map<std::string, dart::dynamics::BodyNode *> bodies_;

  static Pose3d resolved(const sdf::SemanticPose &semantic) {
    Pose3d pose;
    return semantic.Resolve(pose).empty() ? pose : semantic.RawPose();
  }

  static sdf::Model bare(const sdf::Model &model) {
    sdf::Model out;
    out.SetName(model.Name());
    out.SetRawPose(resolved(model.SemanticPose()));
    out.SetStatic(model.Static());
    out.SetSelfCollide(model.SelfCollide());
    out.SetEnableWind(model.EnableWind());
    out.SetCanonicalLinkName(model.CanonicalLinkName());
    return out;
  }

  void finish(const sdf::Model &model, const ModelPtr &made, const std::string &scope) {
    if (!made) {
      left_out.push_back("model " + scope + ": the engine refuses it");
      return;
    }
    for (uint64_t i = 0; i < model.LinkCount(); ++i) add_link(*model.LinkByIndex(i), made, scope);
    for (uint64_t i = 0; i < model.ModelCount(); ++i) nest(*model.ModelByIndex(i), made, scope);
    for (uint64_t i = 0; i < model.JointCount(); ++i) add_joint(*model.JointByIndex(i), made, scope);
  }

  void nest(const sdf::Model &model, const ModelPtr &parent, const std::string &scope) {
    const std::string name = scope + "::" + model.Name();
    if constexpr (Kind::NESTED) {
      finish(model, parent->ConstructNestedModel(bare(model)), name);
    } else {
      left_out.push_back("model " + name + ": the engine has no nested models");
    }
  }

  // along the axes of the link: before 5.3, gz-physics turns an inertia by its pose twice
  static ignition::math::Inertiald turned(const ignition::math::Inertiald &given) {
    ignition::math::MassMatrix3d matrix = given.MassMatrix();
    matrix.SetMoi(given.Moi());
    return {matrix, Pose3d(given.Pose().Pos(), ignition::math::Quaterniond::Identity)};
  }

  void add_link(const sdf::Link &link, const ModelPtr &model, const std::string &scope) {
    const std::string name = scope + "::" + link.Name();
    child::stage("link " + link.Name());
    sdf::Link bare;
    bare.SetName(link.Name());
    bare.SetRawPose(resolved(link.SemanticPose()));
    bare.SetInertial(turned(link.Inertial()));
    Link<Kind> row{name, model->ConstructLink(bare)};
    if constexpr (Kind::OPEN) row.body = newest_body(link.Name());
    bodies_[name] = row.body;
    for (uint64_t i = 0; i < link.CollisionCount(); ++i) add_collision(*link.CollisionByIndex(i), row);
    links.push_back(row);
  }

  // the body that was made last, of that name
  dart::dynamics::BodyNode *newest_body(const std::string &name) {
    const auto all = world->GetDartsimWorld();
    for (std::size_t i = all->getNumSkeletons(); i-- > 0;) {
      auto *body = all->getSkeleton(i)->getBodyNode(name);
      if (body != nullptr) return body;
    }
    return nullptr;
  }

  void add_collision(const sdf::Collision &collision, const Link<Kind> &link) {
    const sdf::Geometry *shape = collision.Geom();
    if (shape == nullptr || shape->MeshShape() != nullptr || shape->HeightmapShape() != nullptr) {
      left_out.push_back("collision " + collision.Name() + " of " + link.name + ": a mesh");
    } else {
      link.made->ConstructCollision(collision);
    }
  }

  static sdf::JointAxis plain(const sdf::JointAxis &axis) {
    sdf::JointAxis out = axis;
    ignition::math::Vector3d direction;
    // an axis that cannot be resolved, or is none, stays as it was written
    if (axis.ResolveXyz(direction).empty() && out.SetXyz(direction).empty()) out.SetXyzExpressedIn("");
    return out;
  }

  // the joint in terms of links: its own pose is relative to the child
  static sdf::Joint plain(const sdf::Joint &joint, const std::string &parent, const std::string &child) {
    sdf::Joint out;
    out.SetName(joint.Name());
    out.SetType(joint.Type());
    out.SetRawPose(resolved(joint.SemanticPose()));
    out.SetThreadPitch(joint.ThreadPitch());
    out.SetParentLinkName(parent);
    out.SetChildLinkName(child);
    for (const unsigned i : {0u, 1u}) {
      if (joint.Axis(i) != nullptr) out.SetAxis(i, plain(*joint.Axis(i)));
    }
    return out;
  }

  void add_joint(const sdf::Joint &joint, const ModelPtr &model, const std::string &scope) {
    std::string parent = joint.ParentLinkName(), child = joint.ChildLinkName();
    joint.ResolveParentLink(parent);
    joint.ResolveChildLink(child);
    const std::string inside = scope + "::";
    Joint<Kind> row{inside + joint.Name(), joint.Type(), parent == "world" ? parent : inside + parent, inside + child, {}};
    child::stage("joint " + joint.Name());
    if constexpr (Kind::JOINTS) row.made = model->ConstructJoint(plain(joint, parent, child));
    const auto body = bodies_.find(row.child);
    if (Kind::OPEN && row.made && body != bodies_.end()) row.body = body->second->getParentJoint();
    joints.push_back(row);
  }
};

}  // namespace scene
