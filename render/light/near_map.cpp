#include "render/light/near_map.h"
#include "render/light/vertex.h"

#include <algorithm>
#include <cmath>

namespace throng::render {

namespace {

using Eigen::Vector3f;

constexpr float kFarM = 20;
constexpr float kLowM = 3.5F;  // roofs of stalls, but not crowns of trees
constexpr int kMaxCells = 1024;

}  // namespace

NearMap::NearMap(const PlaceMeshes& meshes, const Eigen::AlignedBox2d& ground)
    : from_(ground.min().cast<float>()) {
  const Eigen::Vector2f size = ground.sizes().cast<float>();
  cell_m_ = std::max(cell_m_, size.maxCoeff() / kMaxCells);
  columns_ = static_cast<int>(size.x() / cell_m_) + 1;
  rows_ = static_cast<int>(size.y() / cell_m_) + 1;
  distances_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kFarM);
  const auto mark_edges = [&](const auto& vertices, const std::vector<std::uint32_t>& indices,
                              std::size_t end) {
    for (std::size_t i = 0; i + 2 < end; i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3f a = vertex_position(vertices[indices[i + k]]);
        const Vector3f b = vertex_position(vertices[indices[i + (k + 1) % 3]]);
        if (std::min(a.z(), b.z()) < kLowM) mark(a, b);
      }
    }
  };
  mark_edges(meshes.scenery.vertices, meshes.scenery.indices, meshes.scenery.walls.count);
  for (const PlacedProp& prop : meshes.props) {
    if (prop.casts && prop.from_s <= 0)
      mark_edges(prop.mesh.vertices, prop.mesh.indices, prop.mesh.indices.size());
  }
  spread();
}

void NearMap::mark(const Vector3f& from, const Vector3f& to) {
  const int steps = 1 + static_cast<int>((to - from).head<2>().norm() / cell_m_);
  for (int i = 0; i <= steps; ++i) {
    const Vector3f p = from + (to - from) * (static_cast<float>(i) / static_cast<float>(steps));
    const auto column = static_cast<int>(std::floor((p.x() - from_.x()) / cell_m_));
    const auto row = static_cast<int>(std::floor((p.y() - from_.y()) / cell_m_));
    if (p.z() > kLowM || column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
    at(column, row) = 0;
  }
}

// Two passes with the distances of the eight neighbors (Borgefors 1986).
void NearMap::spread() {
  const float straight = cell_m_;
  const float diagonal = 1.4142F * cell_m_;
  const auto relax = [&](int x, int y, int dx, int dy, float step) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= columns_ || y + dy >= rows_) return;
    at(x, y) = std::min(at(x, y), at(x + dx, y + dy) + step);
  };
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      relax(x, y, -1, 0, straight);
      relax(x, y, 0, -1, straight);
      relax(x, y, -1, -1, diagonal);
      relax(x, y, 1, -1, diagonal);
    }
  }
  for (int y = rows_; y-- > 0;) {
    for (int x = columns_; x-- > 0;) {
      relax(x, y, 1, 0, straight);
      relax(x, y, 0, 1, straight);
      relax(x, y, 1, 1, diagonal);
      relax(x, y, -1, 1, diagonal);
    }
  }
}

float NearMap::distance_m(float x, float y) const {
  const auto column = static_cast<int>(std::floor((x - from_.x()) / cell_m_));
  const auto row = static_cast<int>(std::floor((y - from_.y()) / cell_m_));
  if (column < -1 || row < -1 || column > columns_ || row > rows_) return kFarM;
  return distances_[cell_index(std::clamp(column, 0, columns_ - 1), std::clamp(row, 0, rows_ - 1))];
}

}  // namespace throng::render
