#include "render/light/refine.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace throng::render {

namespace {

template <std::size_t n>
std::array<float, n> mean(const std::array<float, n>& a, const std::array<float, n>& b) {
  std::array<float, n> middle{};
  for (std::size_t i = 0; i < n; ++i) middle.at(i) = 0.5F * (a.at(i) + b.at(i));
  return middle;
}

std::array<float, 3> mean_normal(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const std::array<float, 3> sum = mean(a, b);
  const float length = Eigen::Vector3f(sum.data()).norm();
  if (length < 1e-6F) return a;
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

/// `local` is the member with coordinates on the surface.
template <typename Vertex, typename Local>
Vertex mean_vertex(const Vertex& a, const Vertex& b, Local Vertex::*local) {
  Vertex middle = a;
  middle.position = mean(a.position, b.position);
  middle.normal = mean_normal(a.normal, b.normal);
  middle.*local = mean(a.*local, b.*local);
  return middle;
}

}  // namespace

SceneryVertex middle_vertex(const SceneryVertex& a, const SceneryVertex& b) {
  return mean_vertex(a, b, &SceneryVertex::local);
}

PropVertex middle_vertex(const PropVertex& a, const PropVertex& b) {
  return mean_vertex(a, b, &PropVertex::card);
}

}  // namespace throng::render
