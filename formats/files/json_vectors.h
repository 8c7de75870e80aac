// Conversion of JSON arrays to vectors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace throng::formats {

/// The first N numbers of a JSON array. Throws nlohmann::json::exception if there are fewer.
template <int N>
Eigen::Matrix<double, N, 1> numbers_at(const nlohmann::json& array) {
  Eigen::Matrix<double, N, 1> vector;
  for (int i = 0; i < N; ++i) vector[i] = array.at(static_cast<std::size_t>(i)).get<double>();
  return vector;
}

/// A quaternion from the array [w, x, y, z].
inline Eigen::Quaterniond quaternion_at(const nlohmann::json& array) {
  const Eigen::Vector4d q = numbers_at<4>(array);
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace throng::formats
