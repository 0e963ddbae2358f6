// Vectors and poses of Eigen as JSON text.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "../../../twinform/testing/oracles/headers/json.hh"

namespace json {

template <typename Numbers>
std::string numbers(const Numbers &values) {
  std::vector<std::string> out;
  for (Eigen::Index i = 0; i < values.size(); ++i) out.push_back(number(values[i]));
  return list(out);
}

// position, then the quaternion with its real part first
inline std::string pose(const Eigen::Isometry3d &pose) {
  const Eigen::Vector3d p = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  Eigen::Matrix<double, 7, 1> all;
  all << p, q.w(), q.x(), q.y(), q.z();
  return numbers(all);
}

}  // namespace json
