#include "skinning/wardrobe/reveal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace throng::skinning {

namespace {

std::vector<Eigen::Vector3f> skin_normals(const MakeHuman& makehuman) {
  const std::vector<Eigen::Vector3f>& positions = makehuman.base_positions();
  std::vector<Eigen::Vector3f> normals(positions.size(), Eigen::Vector3f::Zero());
  for (const Quad& quad : makehuman.skin()) {
    const Eigen::Vector3f normal =
        (positions[quad.vertex[2]] - positions[quad.vertex[0]])
            .cross(positions[quad.vertex[3]] - positions[quad.vertex[1]]);
    for (const std::uint32_t vertex : quad.vertex) normals[vertex] += normal;
  }
  for (Eigen::Vector3f& normal : normals) {
    if (normal.norm() > 0) normal.normalize();
  }
  return normals;
}

struct Triangle {
  Eigen::Vector3f corner;
  Eigen::Vector3f to_b;
  Eigen::Vector3f to_c;
};

// How far from the skin a garment lies, in meters: it may dip below it.
constexpr float kBelow = 0.01F;
constexpr float kAbove = 0.035F;

// The garment's triangles by the cells of a grid that anything within reach of them starts in.
class Cells {
 public:
  explicit Cells(const Proxy& garment) {
    for (const Quad& quad : garment.quads) {
      for (const auto& [i, j, k] : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
        const Eigen::Vector3f& a = garment.positions[quad.vertex[i]];
        const Eigen::Vector3f& b = garment.positions[quad.vertex[j]];
        const Eigen::Vector3f& c = garment.positions[quad.vertex[k]];
        Eigen::AlignedBox3f box(a);
        box.extend(b).extend(c);
        const Eigen::Vector3f reach = Eigen::Vector3f::Constant(kAbove + kBelow);
        const Cell low = cell_of(box.min() - reach);
        const Cell high = cell_of(box.max() + reach);
        for (int x = low[0]; x <= high[0]; ++x) {
          for (int y = low[1]; y <= high[1]; ++y) {
            for (int z = low[2]; z <= high[2]; ++z) {
              triangles_[{x, y, z}].push_back({a, b - a, c - a});
            }
          }
        }
      }
    }
  }

  const std::vector<Triangle>* at(const Eigen::Vector3f& point) const {
    const auto found = triangles_.find(cell_of(point));
    return found == triangles_.end() ? nullptr : &found->second;
  }

 private:
  using Cell = std::array<int, 3>;
  static Cell cell_of(const Eigen::Vector3f& point) {
    constexpr float kSizeM = 0.06F;
    return {static_cast<int>(std::floor(point.x() / kSizeM)),
            static_cast<int>(std::floor(point.y() / kSizeM)),
            static_cast<int>(std::floor(point.z() / kSizeM))};
  }

  std::map<Cell, std::vector<Triangle>> triangles_;
};

// Moeller and Trumbore's intersection; either side counts.
bool crosses(const Triangle& triangle, const Eigen::Vector3f& origin,
             const Eigen::Vector3f& direction) {
  const Eigen::Vector3f p = direction.cross(triangle.to_c);
  const float determinant = triangle.to_b.dot(p);
  if (std::abs(determinant) < 1e-12F) return false;
  const Eigen::Vector3f s = origin - triangle.corner;
  const float u = s.dot(p) / determinant;
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3f q = s.cross(triangle.to_b);
  const float v = direction.dot(q) / determinant;
  if (v < 0 || u + v > 1) return false;
  const float distance = triangle.to_c.dot(q) / determinant;
  return distance >= 0 && distance <= kAbove + kBelow;
}

}  // namespace

std::vector<bool> skin_under(const MakeHuman& makehuman, const Proxy& garment) {
  const std::vector<Eigen::Vector3f>& positions = makehuman.base_positions();
  const std::vector<Eigen::Vector3f> normals = skin_normals(makehuman);
  const Cells cells(garment);
  std::vector<bool> under(positions.size(), false);
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
    if (normals[vertex].isZero()) continue;  // of a helper
    const Eigen::Vector3f origin = positions[vertex] - kBelow * normals[vertex];
    const std::vector<Triangle>* near = cells.at(origin);
    if (near == nullptr) continue;
    under[vertex] = std::any_of(near->begin(), near->end(), [&](const Triangle& triangle) {
      return crosses(triangle, origin, normals[vertex]);
    });
  }
  return under;
}

std::vector<bool> without_border(const MakeHuman& makehuman, std::vector<bool> vertices, int rows) {
  for (int row = 0; row < rows; ++row) {
    const std::vector<bool> before = vertices;
    for (const Quad& quad : makehuman.skin()) {
      const bool whole = std::all_of(quad.vertex.begin(), quad.vertex.end(),
                                     [&](std::uint32_t vertex) -> bool { return before[vertex]; });
      if (whole) continue;
      for (const std::uint32_t vertex : quad.vertex) vertices[vertex] = false;
    }
  }
  return vertices;
}

}  // namespace throng::skinning
