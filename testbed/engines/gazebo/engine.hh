// What an engine of gz-physics 5 can be asked for; each engine has the features of its own list.
#pragma once

#include <ignition/physics/ConstructEmpty.hh>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/Joint.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/dartsim/World.hh>
#include <ignition/physics/sdf/ConstructCollision.hh>
#include <ignition/physics/sdf/ConstructJoint.hh>
#include <ignition/physics/sdf/ConstructLink.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructNestedModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <stdexcept>
#include <string>

namespace engine {

namespace physics = ignition::physics;

using Common = physics::FeatureList<physics::sdf::ConstructSdfWorld, physics::sdf::ConstructSdfModel,
                                    physics::sdf::ConstructSdfLink, physics::sdf::ConstructSdfCollision,
                                    physics::LinkFrameSemantics, physics::ForwardStep>;
using Joints = physics::FeatureList<physics::sdf::ConstructSdfJoint, physics::GetBasicJointState,
                                    physics::SetBasicJointState, physics::GetBasicJointProperties,
                                    physics::SetJointVelocityCommandFeature>;

struct Dart {
  using Features = physics::FeatureList<Common, Joints, physics::sdf::ConstructSdfNestedModel, physics::dartsim::RetrieveWorld>;
  static constexpr char NAME[] = "dartsim";
  static constexpr bool JOINTS = true, NESTED = true, OPEN = true;
};

// the constraints between free bodies of gz-physics 5, not Bullet Featherstone, which came with gz-physics 6
struct Bullet {
  using Features = physics::FeatureList<Common, Joints>;
  static constexpr char NAME[] = "bullet";
  static constexpr bool JOINTS = true, NESTED = false, OPEN = false;
};

struct Tpe {
  using Features = physics::FeatureList<Common, physics::sdf::ConstructSdfNestedModel>;
  static constexpr char NAME[] = "tpe";
  static constexpr bool JOINTS = false, NESTED = true, OPEN = false;
};

// the engine, from its plugin, which stays loaded
template <typename Kind>
physics::Engine3dPtr<typename Kind::Features> load(const std::string &folder) {
  static ignition::plugin::Loader loader;
  const std::string file = folder + "/libignition-physics5-" + Kind::NAME + "-plugin.so";
  for (const std::string &name : loader.LoadLib(file)) {
    const ignition::plugin::PluginPtr plugin = loader.Instantiate(name);
    if (const auto found = physics::RequestEngine3d<typename Kind::Features>::From(plugin)) return found;
  }
  throw std::runtime_error("there is no engine in " + file);
}

}  // namespace engine
