// Bodies and joints as DART has them.
#pragma once

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Joint.hpp>
#include <string>
#include <vector>

#include "numbers.hh"

namespace dart_view {

// mass in kg, center of mass in the link frame in m, moments about it in the axes of the link frame in kg m^2
inline std::vector<std::string> inertia(const dart::dynamics::BodyNode &body) {
  const auto &inertia = body.getInertia();
  const Eigen::Matrix3d moment = inertia.getMoment();
  Eigen::Matrix<double, 6, 1> moments;
  moments << moment(0, 0), moment(1, 1), moment(2, 2), moment(0, 1), moment(0, 2), moment(1, 2);
  return {json::member("mass", json::number(inertia.getMass())),
          json::member("center", json::numbers(inertia.getLocalCOM())),
          json::member("moments", json::numbers(moments))};
}

// How the child moves with each degree of freedom: angular velocity and velocity of its origin, along the axes of the world.
inline std::string screws(const dart::dynamics::Joint &joint) {
  const Eigen::Matrix3d turn = joint.getChildBodyNode()->getWorldTransform().linear();
  const auto jacobian = joint.getRelativeJacobian();
  std::vector<std::string> out;
  for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
    Eigen::Matrix<double, 6, 1> screw;
    screw << turn * jacobian.col(i).head<3>(), turn * jacobian.col(i).tail<3>();
    out.push_back(json::numbers(screw));
  }
  return json::list(out);
}

// a property of each degree of freedom, by the member function that has it
template <typename Read>
std::string each(const dart::dynamics::Joint &joint, const Read read) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < joint.getNumDofs(); ++i) out.push_back(json::number((joint.*read)(i)));
  return json::list(out);
}

// in SI units and radians
inline std::string described(const dart::dynamics::Joint &joint) {
  using dart::dynamics::Joint;
  return json::object({
      json::member("kind", json::quoted(joint.getType())),
      json::member("screws", screws(joint)),
      json::member("lower", each(joint, &Joint::getPositionLowerLimit)),
      json::member("upper", each(joint, &Joint::getPositionUpperLimit)),
      json::member("effort", each(joint, &Joint::getForceUpperLimit)),
      json::member("velocity", each(joint, &Joint::getVelocityUpperLimit)),
      json::member("damping", each(joint, &Joint::getDampingCoefficient)),
      json::member("friction", each(joint, &Joint::getCoulombFriction)),
      json::member("stiffness", each(joint, &Joint::getSpringStiffness)),
      json::member("rest", each(joint, &Joint::getRestPosition)),
  });
}

}  // namespace dart_view
