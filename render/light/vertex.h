// Positions and normals of the scenery's and the props' vertices.
#pragma once

#include <Eigen/Core>

namespace throng::render {

template <typename Vertex>
Eigen::Vector3f vertex_position(const Vertex& vertex) {
  return Eigen::Vector3f(vertex.position.data());
}

template <typename Vertex>
Eigen::Vector3f vertex_normal(const Vertex& vertex) {
  return Eigen::Vector3f(vertex.normal.data());
}

}  // namespace throng::render
