// Loads URDF and SDF files through libsdformat 12 into an engine of gz-physics 5, lets time pass, and reports what the engine has:
// one JSON object per line for each file named on standard input. Poses are in the world, numbers in SI units and radians.
//
//   gazebo_run FOLDER_OF_PLUGINS dart|bullet|tpe [--steps N] [--dt S] [--every N] [--ground Z] [--start RATE] [--seconds N]
//              [--velocity JOINT=VALUE]... [--force JOINT=VALUE]... [--period S]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ignition/common/Console.hh>

#include "../../../twinform/testing/oracles/headers/loading.hh"
#include "dart_view.hh"
#include "scene.hh"

namespace {

namespace physics = ignition::physics;
using Commands = std::map<std::string, double>;

struct Options {
  std::string folder, engine;
  unsigned steps = 0, every = 0, seconds = 20;
  double dt = 0.001, start = 0.0, period = 0.0;
  std::string ground;  // the height of a plane, if there is one
  Commands velocities, forces;
};

std::string ground(const std::string &height) {
  return R"(<sdf version="1.9"><model name="ground"><static>true</static><pose>0 0 )" + height + R"( 0 0 0</pose>
    <link name="ground"><collision name="ground"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
    </collision></link></model></sdf>)";
}

const char *word(const sdf::JointType kind) {
  switch (kind) {
    case sdf::JointType::BALL: return "ball";
    case sdf::JointType::CONTINUOUS: return "continuous";
    case sdf::JointType::FIXED: return "fixed";
    case sdf::JointType::GEARBOX: return "gearbox";
    case sdf::JointType::PRISMATIC: return "prismatic";
    case sdf::JointType::REVOLUTE: return "revolute";
    case sdf::JointType::REVOLUTE2: return "revolute2";
    case sdf::JointType::SCREW: return "screw";
    case sdf::JointType::UNIVERSAL: return "universal";
    default: return "invalid";
  }
}

template <typename Kind>
std::string described(const scene::Link<Kind> &link) {
  std::vector<std::string> members = {json::member("name", json::quoted(link.name))};
  if (link.body != nullptr) {
    const auto inertia = dart_view::inertia(*link.body);
    members.insert(members.end(), inertia.begin(), inertia.end());
  }
  return json::object(members);
}

template <typename Kind>
std::string described(const scene::Joint<Kind> &joint) {
  std::vector<std::string> members = {
      json::member("name", json::quoted(joint.name)), json::member("kind", json::quoted(word(joint.kind))),
      json::member("parent", json::quoted(joint.parent)), json::member("child", json::quoted(joint.child))};
  if constexpr (Kind::JOINTS) {
    if (joint.made) members.push_back(json::member("freedom", std::to_string(joint.made->GetDegreesOfFreedom())));
  }
  if (joint.body != nullptr) members.push_back(json::member("inside", dart_view::described(*joint.body)));
  return json::object(members);
}

// where everything is, and how it moves: a row for each link and each joint
template <typename Kind>
std::string moment(const scene::Scene<Kind> &scene, const double time) {
  std::vector<std::string> poses, velocities, positions, rates;
  for (const auto &link : scene.links) {
    const physics::FrameData3d data = link.made->FrameDataRelativeToWorld();
    Eigen::Matrix<double, 6, 1> velocity;
    velocity << data.linearVelocity, data.angularVelocity;
    poses.push_back(json::pose(data.pose));
    velocities.push_back(json::numbers(velocity));
  }
  if constexpr (Kind::JOINTS) {
    for (const auto &joint : scene.joints) {
      std::vector<std::string> position, rate;
      for (std::size_t i = 0; joint.made && i < joint.made->GetDegreesOfFreedom(); ++i) {
        position.push_back(json::number(joint.made->GetPosition(i)));
        rate.push_back(json::number(joint.made->GetVelocity(i)));
      }
      positions.push_back(json::list(position));
      rates.push_back(json::list(rate));
    }
  }
  return json::object({json::member("time", json::number(time)), json::member("poses", json::list(poses)),
                       json::member("velocities", json::list(velocities)),
                       json::member("positions", json::list(positions)), json::member("rates", json::list(rates))});
}

// the value for a joint, by its name in its model or by its whole name
const double *command(const Commands &commands, const std::string &name) {
  auto found = commands.find(name);
  if (found == commands.end()) found = commands.find(name.substr(name.find("::") + 2));
  return found == commands.end() ? nullptr : &found->second;
}

// the share of a force at a time: all of it, or that of a sine
double share(const Options &options, const double time) {
  return options.period == 0.0 ? 1.0 : std::sin(2.0 * M_PI * time / options.period);
}

template <typename Kind>
void drive(const scene::Scene<Kind> &scene, const Options &options, const double time) {
  if constexpr (Kind::JOINTS) {
    for (const auto &joint : scene.joints) {
      if (!joint.made || joint.made->GetDegreesOfFreedom() == 0) continue;
      if (const double *value = command(options.velocities, joint.name)) joint.made->SetVelocityCommand(0, *value);
      if (const double *value = command(options.forces, joint.name)) joint.made->SetForce(0, *value * share(options, time));
    }
  }
}

template <typename Kind>
void start(const scene::Scene<Kind> &scene, const double rate) {
  if constexpr (Kind::OPEN) {  // Bullet takes no rates, and logs that for each joint
    for (const auto &joint : scene.joints) {
      for (std::size_t i = 0; joint.made && i < joint.made->GetDegreesOfFreedom(); ++i) joint.made->SetVelocity(i, rate);
    }
  }
}

template <typename Kind>
std::vector<std::string> moments(const scene::Scene<Kind> &scene, const Options &options) {
  std::vector<std::string> out = {moment(scene, 0.0)};
  if (options.start != 0.0) start(scene, options.start);
  physics::ForwardStep::Input input;
  physics::ForwardStep::Output output;
  physics::ForwardStep::State state;
  using Duration = std::chrono::steady_clock::duration;
  input.Get<Duration>() = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(options.dt));
  for (unsigned step = 1; step <= options.steps; ++step) {
    child::stage("step " + std::to_string(step));
    drive(scene, options, (step - 1) * options.dt);
    scene.world->Step(output, state, input);
    const bool wanted = options.every != 0 && step % options.every == 0;
    if (wanted || step == options.steps) out.push_back(moment(scene, step * options.dt));
  }
  return out;
}

std::vector<const sdf::Model *> models(const sdf::Root &root) {
  std::vector<const sdf::Model *> out;
  if (root.Model() != nullptr) out.push_back(root.Model());
  for (uint64_t i = 0; root.WorldCount() != 0 && i < root.WorldByIndex(0)->ModelCount(); ++i) {
    out.push_back(root.WorldByIndex(0)->ModelByIndex(i));
  }
  return out;
}

template <typename Kind>
std::string run(const physics::Engine3dPtr<typename Kind::Features> &engine, const sdf::Root &root, const Options &options) {
  scene::Scene<Kind> scene(engine, root.WorldCount() == 0 ? nullptr : root.WorldByIndex(0));
  sdf::Root plane;
  if (!options.ground.empty() && plane.LoadSdfString(ground(options.ground)).empty()) scene.add(*plane.Model());
  for (const sdf::Model *model : models(root)) scene.add(*model);
  std::vector<std::string> links, joints, left_out;
  child::stage("describing");
  for (const auto &link : scene.links) links.push_back(described<Kind>(link));
  for (const auto &joint : scene.joints) joints.push_back(described<Kind>(joint));
  for (const auto &what : scene.left_out) left_out.push_back(json::quoted(what));
  return json::list({json::member("links", json::list(links)), json::member("joints", json::list(joints)),
                     json::member("left_out", json::list(left_out)),
                     json::member("moments", json::list(moments(scene, options)))});
}

template <typename Kind>
void answer(const std::string &path, const sdf::SDFPtr &description,
            const physics::Engine3dPtr<typename Kind::Features> &engine, const Options &options) {
  const child::Ending ending = child::call([&] {
    child::stage("loading");
    sdf::Root root;
    std::vector<std::string> errors;
    for (const sdf::Error &each : loading::load(path, description, root)) {
      errors.push_back(json::quoted(std::to_string(static_cast<int>(each.Code())) + ": " + each.Message()));
    }
    const std::string listed = json::member("errors", json::list(errors));
    if (!errors.empty()) return listed;
    const std::string inside = run<Kind>(engine, root, options);
    return listed + ", " + inside.substr(1, inside.size() - 2);
  }, options.seconds);
  std::vector<std::string> members = {json::member("path", json::quoted(path)),
                                      json::member("signal", std::to_string(ending.signal)),
                                      json::member("stage", json::quoted(ending.stage)),
                                      json::member("console", json::quoted(ending.console))};
  if (ending.signal == 0) members.push_back(ending.answer);
  std::cout << json::object(members) << std::endl;
}

template <typename Kind>
int serve(const Options &options) {
  const auto engine = engine::load<Kind>(options.folder);
  const sdf::SDFPtr description(new sdf::SDF());
  sdf::init(description);
  std::string path;
  while (std::getline(std::cin, path)) answer<Kind>(path, description, engine, options);
  return 0;
}

void set(Commands &commands, const std::string &text) {
  const size_t middle = text.rfind('=');
  commands[text.substr(0, middle)] = std::stod(text.substr(middle + 1));
}

Options parsed(const std::vector<std::string> &words) {
  Options options{words.at(0), words.at(1)};
  for (size_t i = 2; i < words.size(); ++i) {
    const std::string &name = words[i];
    const std::string &value = words.at(++i);
    if (name == "--ground") options.ground = value;
    if (name == "--steps") options.steps = static_cast<unsigned>(std::stoul(value));
    if (name == "--every") options.every = static_cast<unsigned>(std::stoul(value));
    if (name == "--seconds") options.seconds = static_cast<unsigned>(std::stoul(value));
    if (name == "--dt") options.dt = std::stod(value);
    if (name == "--start") options.start = std::stod(value);
    if (name == "--period") options.period = std::stod(value);
    if (name == "--velocity") set(options.velocities, value);
    if (name == "--force") set(options.forces, value);
  }
  return options;
}

}  // namespace

int main(int count, char **arguments) {
  ignition::common::Console::SetVerbosity(3);
  const Options options = parsed({arguments + 1, arguments + count});
  if (options.engine == "dart") return serve<engine::Dart>(options);
  if (options.engine == "bullet") return serve<engine::Bullet>(options);
  return serve<engine::Tpe>(options);
}
