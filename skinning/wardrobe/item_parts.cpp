#include "skinning/wardrobe/item_parts.h"

#include <Eigen/Geometry>
#include <cmath>

#include "skinning/wardrobe/item_shapes.h"

namespace throng::skinning::items {

using Eigen::Vector2f;
using Eigen::Vector3f;

BoneWeights all_on(Bone bone) {
  BoneWeights weights{};
  weights[index_from(bone)] = 1;
  return weights;
}

std::uint32_t Shape::add(const Vector3f& position, const Vector3f& normal, const Vector2f& uv,
                         const BoneWeights& weights) {
  surface_.source.push_back(static_cast<std::uint32_t>(surface_.source.size()));
  surface_.fitted.push_back(position);
  surface_.positions.push_back(position);
  surface_.normals.push_back(normal.normalized());
  surface_.uvs.push_back(uv);
  surface_.weights.push_back(weights);
  return surface_.source.back();
}

void Shape::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  surface_.indices.insert(surface_.indices.end(), {a, b, c});
}

void Shape::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

Surface Shape::take() {
  surface_.texture = kItemTexture;
  surface_.tint = Tint::item;
  return std::move(surface_);
}

void add_box(Shape& shape, const Box& box) {
  const Vector3f& half = box.half;
  const int rings = box.rings;
  const int columns = box.columns;
  constexpr float kSquareness = 0.32F;  // exponent: 1 is an ellipsoid, 0 a box
  const auto power = [](float value) {
    return std::copysign(std::pow(std::abs(value), kSquareness), value);
  };
  const BoneWeights weights = all_on(box.bone);
  std::vector<std::uint32_t> place;
  // Boxes of few columns have their corners where the rounded edges are: between the sides and the
  // corners of the box that they round, so that both are missed by as much.
  const float corner = power(std::cos(kPi / static_cast<float>(columns)));
  const float wide = 1 / std::sqrt(corner);
  for (int ring = 0; ring <= rings; ++ring) {
    const float up = kPi * (static_cast<float>(ring) / static_cast<float>(rings) - 0.5F);
    for (int column = 0; column <= columns; ++column) {
      const float turn =
          2 * kPi * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns);
      const float flat = wide * power(std::cos(up));
      const Vector3f unit(flat * power(std::cos(turn)), flat * power(std::sin(turn)),
                          power(std::sin(up)));
      const Vector3f normal(std::cos(up) * std::cos(turn) / half.x(),
                            std::cos(up) * std::sin(turn) / half.y(), std::sin(up) / half.z());
      const Vector2f uv(0.5F * (0.06F + 0.44F * (1 + unit.y())), 0.5F - 0.44F * unit.z());
      place.push_back(shape.add(box.center + box.turn * half.cwiseProduct(unit), box.turn * normal,
                                uv, weights));
    }
  }
  const auto at = [&](int ring, int column) {
    return place[static_cast<std::size_t>(ring) * (columns + 1) + column];
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      if (ring > 0) shape.triangle(at(ring, column), at(ring, column + 1), at(ring + 1, column));
      if (ring + 1 < rings) {
        shape.triangle(at(ring, column + 1), at(ring + 1, column + 1), at(ring + 1, column));
      }
    }
  }
}

void add_strap(Shape& shape, const std::vector<StrapPoint>& path, float width_m, bool closed) {
  std::vector<std::array<std::uint32_t, 4>> rows;  // outside left, right; inside left, right
  const std::size_t count = path.size();
  for (std::size_t i = 0; i < count; ++i) {
    const StrapPoint& here = path[i];
    const StrapPoint& before = path[i > 0 ? i - 1 : closed ? count - 1 : 0];
    const StrapPoint& after = path[i + 1 < count ? i + 1 : closed ? 0 : count - 1];
    const Vector3f along = (after.position - before.position).normalized();
    const Vector3f across = 0.5F * width_m * along.cross(here.out).normalized();
    rows.push_back({shape.add(here.position + across, here.out, kDark, here.weights),
                    shape.add(here.position - across, here.out, kDark, here.weights),
                    shape.add(here.position + across, -here.out, kDark, here.weights),
                    shape.add(here.position - across, -here.out, kDark, here.weights)});
  }
  for (std::size_t i = 0; i + 1 < count + (closed ? 1 : 0); ++i) {
    const auto& a = rows[i];
    const auto& b = rows[(i + 1) % count];
    shape.quad(a[0], b[0], b[1], a[1]);
    shape.quad(a[2], a[3], b[3], b[2]);
  }
}

void add_rod(Shape& shape, const Vector3f& from, const Vector3f& to, float radius_m, Bone bone,
             const Vector2f& uv, int sides) {
  const Vector3f axis = (to - from).normalized();
  const bool is_across = std::abs(axis.y()) > 0.9F;
  const Vector3f u =
      axis.cross(is_across ? Vector3f(Vector3f::UnitX()) : Vector3f(Vector3f::UnitY()))
          .normalized();
  const Vector3f v = axis.cross(u);
  const BoneWeights weights = all_on(bone);
  // By side: on the rod's surface at both ends, then on the ends' own faces.
  std::vector<std::array<std::uint32_t, 4>> rows;
  for (int i = 0; i < sides; ++i) {
    const float turn = 2 * kPi * (static_cast<float>(i) + 0.5F) / static_cast<float>(sides);
    const Vector3f out = std::cos(turn) * u + std::sin(turn) * v;
    const Vector3f low = from + radius_m * out;
    const Vector3f high = to + radius_m * out;
    rows.push_back({shape.add(low, out, uv, weights), shape.add(high, out, uv, weights),
                    shape.add(low, -axis, uv, weights), shape.add(high, axis, uv, weights)});
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& a = rows[i];
    const auto& b = rows[(i + 1) % rows.size()];
    shape.quad(a[0], b[0], b[1], a[1]);
    if (i == 0 || i + 1 == rows.size()) continue;
    shape.triangle(rows[0][2], b[2], a[2]);
    shape.triangle(rows[0][3], a[3], b[3]);
  }
}

void add_tire(Shape& shape, const Vector3f& center, float radius_m, float half_tube_m,
              int segments) {
  constexpr int kRound = 3;  // corners of the tube: one outside, two inside
  const BoneWeights weights = all_on(kStill);
  std::vector<std::array<std::uint32_t, kRound>> rows;
  for (int i = 0; i < segments; ++i) {
    const float turn = 2 * kPi * static_cast<float>(i) / static_cast<float>(segments);
    const Vector3f out(std::cos(turn), 0, std::sin(turn));
    std::array<std::uint32_t, kRound>& row = rows.emplace_back();
    for (int k = 0; k < kRound; ++k) {
      const float around = 2 * kPi * static_cast<float>(k) / kRound;
      const Vector3f normal = std::cos(around) * out + std::sin(around) * Vector3f::UnitY();
      row[static_cast<std::size_t>(k)] = shape.add(
          center + (radius_m - half_tube_m) * out + half_tube_m * normal, normal, kBlack, weights);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& a = rows[i];
    const auto& b = rows[(i + 1) % rows.size()];
    for (std::size_t k = 0; k < kRound; ++k) {
      shape.quad(a[k], a[(k + 1) % kRound], b[(k + 1) % kRound], b[k]);
    }
  }
}

}  // namespace throng::skinning::items
