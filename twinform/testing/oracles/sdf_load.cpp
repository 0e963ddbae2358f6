// Loads files with libsdformat 12 and reports its verdict on each, one JSON object per line.
// File names come from the arguments, or from standard input, one per line. After `--robots` the first model of each
// file is described too, with the models in it: poses in the frame of that model, and everything in SI units. After
// `--models` all models of the root and of the worlds are.
//
// The description of the format, which takes longer to read than most files, is read once. Every file is loaded by a
// fork of the process, so that one on which the library crashes or hangs spoils no other.
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sdf/sdf.hh>
#include <sstream>
#include <string>
#include <vector>

#include "headers/child.hh"
#include "headers/json.hh"
#include "headers/loading.hh"

namespace {

constexpr unsigned SECONDS_PER_FILE = 20;

using ignition::math::Pose3d;

template <typename... Numbers>
std::string numbers(const Numbers... values) {
  std::string out;
  ((out += (out.empty() ? "[" : ", ") + json::number(values)), ...);
  return out + "]";
}

// position, then the quaternion with its real part first
std::string written(const Pose3d &pose) {
  const auto &p = pose.Pos();
  const auto &r = pose.Rot();
  return numbers(p.X(), p.Y(), p.Z(), r.W(), r.X(), r.Y(), r.Z());
}

// what could not be resolved stays where it is, and the errors of loading say so
Pose3d resolved(const sdf::SemanticPose &semantic, const std::string &frame) {
  Pose3d pose;
  semantic.Resolve(pose, frame);
  return pose;
}

// whether an element is another row, or is described with numbers; an extension has no default values
bool is_apart(const std::string &name) {
  for (const char *each : {"pose", "geometry", "inertial", "visual", "collision", "sensor", "light", "plugin", "link",
                           "joint", "frame", "model", "include"}) {
    if (name == each) return true;
  }
  return name.find(':') != std::string::npos;
}

// the text of a value, which it may have in several ways: `1` is `true`, `0.0` is `0`, and a color may leave out its alpha
std::string spelt(const sdf::ParamPtr &value, const std::string &text) {
  if (value->GetTypeName() == "bool") return text == "1" || text == "true" ? "true" : "false";
  std::istringstream words(text);
  std::string word, out;
  int count = 0;
  for (; words >> word; ++count) {
    char *end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    out += (out.empty() ? "" : " ") + (*end == '\0' ? json::number(number) : word);
  }
  return value->GetTypeName() == "color" && count == 3 ? out + " 1" : out;
}

// whether the library reads a child of an element: of those with one name the first, of the workflows of <pbr> the last
bool counts(const sdf::ElementPtr &element, const sdf::ElementPtr &child) {
  if (element->GetName() == "pbr") return child->GetNextElement(child->GetName()) == nullptr;
  return element->FindElement(child->GetName()) == child;
}

// the values below an element that are not the library's default, each by its path
void collect(const sdf::ElementPtr &element, const std::string &path, std::vector<std::string> &found) {
  const auto add = [&found](const std::string &at, const sdf::ParamPtr &value) {
    if (!value) return;
    const std::string text = spelt(value, value->GetAsString());
    if (text != spelt(value, value->GetDefaultAsString())) found.push_back(json::member(at, json::quoted(text)));
  };
  for (sdf::ElementPtr child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    if (is_apart(child->GetName()) || !counts(element, child)) continue;
    const std::string at = path.empty() ? child->GetName() : path + "/" + child->GetName();
    add(at, child->GetValue());
    for (const sdf::ParamPtr &attribute : child->GetAttributes()) add(at + "/@" + attribute->GetKey(), attribute);
    collect(child, at, found);
  }
}

std::string values(const sdf::ElementPtr &element) {
  std::vector<std::string> found;
  collect(element, "", found);
  return json::object(found);
}

// what a link has, and what the model that it is in sets for its links where that is not the outermost one
std::string values(const sdf::Link &link, const sdf::Model &model, const std::string &scope) {
  const sdf::ElementPtr element = link.Element()->Clone();
  for (const char *name : {"self_collide", "enable_wind"}) {
    if (scope.empty() || element->HasElement(name) || !model.Element()->HasElement(name)) continue;
    element->GetElement(name)->Set(model.Element()->Get<bool>(name));
  }
  return values(element);
}

template <typename Shape>
void describe_shape(const char *kind, const Shape &shape, const char *&separator) {
  std::cout << separator << "{\"kind\": \"" << kind << "\", \"name\": " << json::quoted(shape.Name())
            << ", \"pose\": " << written(shape.RawPose())
            << ", \"place\": " << written(resolved(shape.SemanticPose(), ""))
            << ", \"geometry\": " << (shape.Geom() == nullptr ? 0 : static_cast<int>(shape.Geom()->Type()))
            << ", \"values\": " << values(shape.Element()) << "}";
  separator = ", ";
}

void describe_shapes(const sdf::Link &link) {
  const char *separator = "";
  for (uint64_t i = 0; i < link.VisualCount(); ++i) describe_shape("visual", *link.VisualByIndex(i), separator);
  for (uint64_t i = 0; i < link.CollisionCount(); ++i) describe_shape("collision", *link.CollisionByIndex(i), separator);
}

void describe_link(const sdf::Link &link, const sdf::Model &model, const std::string &scope, const Pose3d &pose) {
  const auto &inertial = link.Inertial();
  const auto &mass = inertial.MassMatrix();
  std::cout << "{\"name\": " << json::quoted(scope + link.Name())
            << ", \"pose\": " << written(pose * resolved(link.SemanticPose(), "__model__"))
            << ", \"mass\": " << json::number(mass.Mass()) << ", \"center\": " << written(inertial.Pose())
            << ", \"moments\": "
            << numbers(mass.Ixx(), mass.Iyy(), mass.Izz(), mass.Ixy(), mass.Ixz(), mass.Iyz())
            << ", \"values\": " << values(link, model, scope) << ", \"shapes\": [";
  describe_shapes(link);
  std::cout << "]}";
}

void describe_axis(const sdf::Joint &joint) {
  const sdf::JointAxis *axis = joint.Axis(0);
  if (axis == nullptr) return;
  ignition::math::Vector3d direction;
  axis->ResolveXyz(direction, joint.Name());
  std::cout << ", \"axis\": " << numbers(direction.X(), direction.Y(), direction.Z()) << ", \"limits\": {\"lower\": "
            << json::number(axis->Lower()) << ", \"upper\": " << json::number(axis->Upper())
            << ", \"velocity\": " << json::number(axis->MaxVelocity()) << ", \"effort\": " << json::number(axis->Effort())
            << ", \"damping\": " << json::number(axis->Damping()) << ", \"friction\": " << json::number(axis->Friction()) << "}";
}

void describe_joint(const sdf::Joint &joint, const std::string &scope, const Pose3d &model) {
  std::string parent = joint.ParentLinkName(), child = joint.ChildLinkName();
  joint.ResolveParentLink(parent);
  joint.ResolveChildLink(child);
  std::cout << "{\"name\": " << json::quoted(scope + joint.Name()) << ", \"kind\": " << static_cast<int>(joint.Type())
            << ", \"parent\": " << json::quoted(parent == "world" ? parent : scope + parent)
            << ", \"child\": " << json::quoted(scope + child)
            << ", \"pose\": " << written(model * resolved(joint.SemanticPose(), "__model__"));
  describe_axis(joint);
  std::cout << "}";
}

void describe_links(const sdf::Model &model, const std::string &scope, const Pose3d &pose, const char *&separator) {
  for (uint64_t i = 0; i < model.LinkCount(); ++i, separator = ", ") {
    std::cout << separator;
    describe_link(*model.LinkByIndex(i), model, scope, pose);
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model &inner = *model.ModelByIndex(i);
    describe_links(inner, scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__"), separator);
  }
}

void describe_joints(const sdf::Model &model, const std::string &scope, const Pose3d &pose, const char *&separator) {
  for (uint64_t i = 0; i < model.JointCount(); ++i, separator = ", ") {
    std::cout << separator;
    describe_joint(*model.JointByIndex(i), scope, pose);
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model &inner = *model.ModelByIndex(i);
    describe_joints(inner, scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__"), separator);
  }
}

// the XML of an element, without its pose, which is reported separately
std::string written(const sdf::ElementPtr &element) {
  const sdf::ElementPtr copy = element->Clone();
  if (copy->HasElement("pose")) copy->RemoveChild(copy->GetElement("pose"));
  return json::quoted(copy->ToString(""));
}

void describe_sensor(const sdf::Sensor &sensor, const std::string &inside, const Pose3d &model, const char *&separator) {
  std::cout << separator << "{\"name\": " << json::quoted(sensor.Name()) << ", \"inside\": " << json::quoted(inside)
            << ", \"kind\": " << json::quoted(sensor.TypeStr())
            << ", \"pose\": " << written(model * resolved(sensor.SemanticPose(), "__model__"))
            << ", \"text\": " << written(sensor.Element()) << "}";
  separator = ", ";
}

void describe_sensors(const sdf::Model &model, const std::string &scope, const Pose3d &pose, const char *&separator) {
  for (uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link &link = *model.LinkByIndex(i);
    for (uint64_t k = 0; k < link.SensorCount(); ++k) describe_sensor(*link.SensorByIndex(k), scope + link.Name(), pose, separator);
  }
  for (uint64_t i = 0; i < model.JointCount(); ++i) {
    const sdf::Joint &joint = *model.JointByIndex(i);
    for (uint64_t k = 0; k < joint.SensorCount(); ++k) describe_sensor(*joint.SensorByIndex(k), scope + joint.Name(), pose, separator);
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model &inner = *model.ModelByIndex(i);
    describe_sensors(inner, scope + inner.Name() + "::", pose * resolved(inner.SemanticPose(), "__model__"), separator);
  }
}

// plugins at any depth, with the kind of element that they are in and the names around them, as elements of a list;
// those in an extension are its own
void describe_plugins(const sdf::ElementPtr &element, const std::string &names, const char *&separator) {
  for (sdf::ElementPtr child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    if (child->GetName() == "plugin") {
      std::cout << separator << "{\"inside\": " << json::quoted(element->GetName()) << ", \"parts\": [" << names
                << "], \"text\": " << json::quoted(child->ToString("")) << "}";
      separator = ", ";
    } else if (child->GetName().find(':') == std::string::npos) {
      const std::string name = child->HasAttribute("name") ? json::quoted(child->Get<std::string>("name")) : "";
      describe_plugins(child, names + (names.empty() || name.empty() ? "" : ", ") + name, separator);
    }
  }
}

std::vector<const sdf::Model *> models_of(const sdf::Root &root) {
  std::vector<const sdf::Model *> found;
  if (root.Model() != nullptr) found.push_back(root.Model());
  for (uint64_t i = 0; i < root.WorldCount(); ++i) {
    const sdf::World &world = *root.WorldByIndex(i);
    for (uint64_t k = 0; k < world.ModelCount(); ++k) found.push_back(world.ModelByIndex(k));
  }
  return found;
}

// the place of a model in its world, which is where the file has it unless it is relative to something there
Pose3d in_world(const sdf::Model &model) {
  Pose3d pose;
  return model.SemanticPose().Resolve(pose).empty() ? pose : model.RawPose();
}

void describe(const sdf::Model &model) {
  const char *separator = "";
  std::cout << "{\"name\": " << json::quoted(model.Name()) << ", \"pose\": " << written(in_world(model))
            << ", \"static\": " << (model.Static() ? "true" : "false")
            << ", \"values\": " << values(model.Element()) << ", \"links\": [";
  describe_links(model, "", Pose3d::Zero, separator);
  separator = "";
  std::cout << "], \"joints\": [";
  describe_joints(model, "", Pose3d::Zero, separator);
  separator = "";
  std::cout << "], \"sensors\": [";
  describe_sensors(model, "", Pose3d::Zero, separator);
  separator = "";
  std::cout << "], \"plugins\": [";
  describe_plugins(model.Element(), "", separator);
  std::cout << "]}";
}

// what is described of a file: nothing, its first model, or all
enum class Described { NOTHING, FIRST, ALL };

void describe(const sdf::Root &root, const Described what) {
  const std::vector<const sdf::Model *> models = models_of(root);
  if (what == Described::FIRST && !models.empty()) {
    std::cout << ", \"robot\": ";
    describe(*models.front());
  }
  if (what != Described::ALL) return;
  std::cout << ", \"models\": [";
  for (size_t i = 0; i < models.size(); ++i) {
    if (i > 0) std::cout << ", ";
    describe(*models[i]);
  }
  std::cout << "]";
}

std::string error(const int code, const std::string &message) {
  return "{\"code\": " + std::to_string(code) + ", \"message\": " + json::quoted(message) + "}";
}

void judge(const std::string &path, const sdf::SDFPtr &description, const Described what) {
  sdf::Root root;
  const sdf::Errors errors = loading::load(path, description, root);
  std::cout << "\"ok\": " << (errors.empty() ? "true" : "false") << ", \"errors\": [";
  const char *separator = "";
  for (const sdf::Error &each : errors) {
    std::cout << separator << error(static_cast<int>(each.Code()), each.Message());
    separator = ", ";
  }
  std::cout << "]";
  describe(root, what);
}

// its verdict, as members of a JSON object, from a process of its own; `console` has what it writes beside
std::string verdict(const std::string &path, const sdf::SDFPtr &description, const Described what, const int console) {
  const int answer = child::memory("answer");
  const pid_t process = fork();
  if (process == 0) {
    const itimerval limit{{0, 0}, {SECONDS_PER_FILE, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);  // of its own time: on a busy machine a large file waits longer than this
    alarm(10 * SECONDS_PER_FILE);
    dup2(answer, STDOUT_FILENO);
    dup2(console, STDERR_FILENO);
    judge(path, description, what);
    std::cout.flush();
    _exit(0);
  }
  int status = 0;
  waitpid(process, &status, 0);
  const std::string text = child::contents(answer);
  close(answer);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return text;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const std::string how = signal == SIGPROF || signal == SIGALRM ? "did not come to an end" : "crashed";
  return "\"ok\": false, \"errors\": [" + error(0, "libsdformat " + how) + "]";
}

void answer(const std::string &path, const sdf::SDFPtr &description, const Described what) {
  const int console = child::memory("console");
  const std::string text = verdict(path, description, what, console);
  std::cout << "{\"path\": " << json::quoted(path) << ", " << text << ", \"console\": " << json::quoted(child::contents(console)) << "}"
            << std::endl;
  close(console);
}

Described asked(const std::string &word) {
  if (word == "--robots") return Described::FIRST;
  return word == "--models" ? Described::ALL : Described::NOTHING;
}

}  // namespace

int main(int count, char **arguments) {
  const Described what = asked(count > 1 ? arguments[1] : "");
  const int first = what == Described::NOTHING ? 1 : 2;
  const sdf::SDFPtr description(new sdf::SDF());
  sdf::init(description);
  for (int i = first; i < count; ++i) answer(arguments[i], description, what);
  std::string path;
  while (count == first && std::getline(std::cin, path)) answer(path, description, what);
  return 0;
}
