// Builds procedural shapes from quads, blocks and tubes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/compute/random.h"
#include "render/props/leaf_sprites.h"
#include "render/props/letter_sprites.h"
#include "render/props/prop_mesh.h"
#include "world/props.h"

namespace throng::render {

/// Collects surfaces given in the prop's frame (m): x along its heading, z up, its ground point at
/// the origin. `paint` is linear RGB, 0 to 1. Corners are counter-clockwise from outside.
class PropBuilder {
 public:
  PropBuilder(const world::Prop& prop, std::uint32_t id)
      : prop_(prop), id_(id), random_(prop.look, Stream::environment) {}

  /// The mesh: first what is only drawn far away, at the end what is only drawn near.
  PropMesh take() {
    mesh_.only_far = far_indices_.size();
    mesh_.indices.insert(mesh_.indices.begin(), far_indices_.begin(), far_indices_.end());
    mesh_.far_indices = mesh_.indices.size();
    mesh_.indices.insert(mesh_.indices.end(), near_indices_.begin(), near_indices_.end());
    return std::move(mesh_);
  }
  Random& random() { return random_; }

  /// The pose, in the prop's frame, of surfaces that are added from now on, which it may scale and
  /// mirror.
  Eigen::Affine3d placing = Eigen::Affine3d::Identity();
  /// Whether they are details that are only drawn near.
  bool is_near = false;
  /// Whether they stand for details, and are only drawn far away.
  bool is_far = false;

  void quad(const std::array<Eigen::Vector3d, 4>& corners, const Eigen::Vector3d& paint,
            Finish finish) {
    const Eigen::Vector3d normal =
        (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
    quad(corners, {normal, normal, normal, normal}, paint, finish);
  }

  void quad(const std::array<Eigen::Vector3d, 4>& corners,
            const std::array<Eigen::Vector3d, 4>& normals, const Eigen::Vector3d& paint,
            Finish finish) {
    constexpr std::array<std::array<float, 2>, 4> kCard = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d normal = placing.linear() * normals[i];
      mesh_.vertices.push_back({three(prop_.scale * turned(placing * corners[i]) +
                                      Eigen::Vector3d(prop_.position.x(), prop_.position.y(), 0)),
                                three(turned(normal.normalized())),
                                kCard[i],
                                painted(paint, finish),
                                id_,
                                {}});
    }
    std::vector<std::uint32_t>& indices = is_near  ? near_indices_
                                          : is_far ? far_indices_
                                                   : mesh_.indices;
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (corners[a] == corners[b] || corners[b] == corners[c] || corners[c] == corners[a]) return;
      // A mirrored surface keeps its outside.
      if (placing.linear().determinant() < 0) std::swap(a, c);
      for (const std::uint32_t corner : {a, b, c}) indices.push_back(first + corner);
    };
    triangle(0, 1, 2);
    triangle(0, 2, 3);
  }

  /// Adds a card with a sprite of leaves, lit as a surface with this normal.
  void leaves(const std::array<Eigen::Vector3d, 4>& corners, const Eigen::Vector3d& normal,
              const Eigen::Vector3d& paint, LeafSprite sprite) {
    leaves(corners, {normal, normal, normal, normal}, paint, sprite);
  }

  /// The same, lit as a curved surface with these normals at its corners.
  void leaves(const std::array<Eigen::Vector3d, 4>& corners,
              const std::array<Eigen::Vector3d, 4>& normals, const Eigen::Vector3d& paint,
              LeafSprite sprite) {
    quad(corners, normals, paint, Finish::leaves);
    // The whole part of the first coordinate says which sprite it is.
    for (std::size_t i = mesh_.vertices.size() - corners.size(); i < mesh_.vertices.size(); ++i) {
      mesh_.vertices[i].card[0] += 2 * static_cast<float>(sprite);
    }
  }

  /// Adds a card with a word of kShopWords, of the aspect kLetterAspect.
  void word(const std::array<Eigen::Vector3d, 4>& corners, const Eigen::Vector3d& normal,
            const Eigen::Vector3d& paint, std::size_t number) {
    quad(corners, {normal, normal, normal, normal}, paint, Finish::leaves);
    const std::size_t sheet = number / kWordsPerSheet;
    const auto layer = static_cast<float>(kLeafSprites + sheet);
    const auto row = static_cast<float>(number % kWordsPerSheet);
    for (std::size_t i = mesh_.vertices.size() - corners.size(); i < mesh_.vertices.size(); ++i) {
      std::array<float, 2>& card = mesh_.vertices[i].card;
      card = {card[0] + 2 * layer, (row + card[1]) / kWordsPerSheet};
    }
  }

  /// Adds a block between two horizontal rectangles, without a side that lies on the ground.
  void block(const Eigen::AlignedBox2d& below, double z0, const Eigen::AlignedBox2d& above,
             double z1, const Eigen::Vector3d& paint, Finish finish = Finish::matt) {
    const auto at = [](const Eigen::AlignedBox2d& box, int corner, double z) {
      return Eigen::Vector3d(corner == 0 || corner == 3 ? box.min().x() : box.max().x(),
                             corner < 2 ? box.min().y() : box.max().y(), z);
    };
    for (int side = 0; side < 4; ++side) {
      const int next = (side + 1) % 4;
      quad({at(below, side, z0), at(below, next, z0), at(above, next, z1), at(above, side, z1)},
           paint, finish);
    }
    quad({at(above, 0, z1), at(above, 1, z1), at(above, 2, z1), at(above, 3, z1)}, paint, finish);
    const bool is_on_ground =
        (placing * at(below, 0, z0)).z() <= 0 && (placing * at(below, 2, z0)).z() <= 0;
    if (!is_on_ground) {
      quad({at(below, 3, z0), at(below, 2, z0), at(below, 1, z0), at(below, 0, z0)}, paint, finish);
    }
  }

  void box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Eigen::Vector3d& paint,
           Finish finish = Finish::matt) {
    const Eigen::AlignedBox2d outline(low.head<2>(), high.head<2>());
    block(outline, low.z(), outline, high.z(), paint, finish);
  }

  /// Adds a tube from one point to another, closed at its end.
  void tube(const Eigen::Vector3d& from, double radius_from, const Eigen::Vector3d& to,
            double radius_to, const Eigen::Vector3d& paint, Finish finish = Finish::matt,
            int sides = 8) {
    const Eigen::Vector3d axis = (to - from).normalized();
    const Eigen::Vector3d u = axis.unitOrthogonal();
    const Eigen::Vector3d v = axis.cross(u);
    const auto out = [&](int i) -> Eigen::Vector3d {
      const double angle = 2 * std::numbers::pi * i / sides;
      return std::cos(angle) * u + std::sin(angle) * v;
    };
    for (int i = 0; i < sides; ++i) {
      const Eigen::Vector3d a = out(i);
      const Eigen::Vector3d b = out(i + 1);
      quad({from + radius_from * a, from + radius_from * b, to + radius_to * b, to + radius_to * a},
           {a, b, b, a}, paint, finish);
      if (i % 2 == 0 && radius_to > 0) {
        quad({to, to + radius_to * a, to + radius_to * b, to + radius_to * out(i + 2)}, paint,
             finish);
      }
    }
  }

 private:
  static std::array<float, 3> three(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }

  static std::array<std::uint8_t, 4> painted(const Eigen::Vector3d& paint, Finish finish) {
    const auto byte = [](double share) {
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
    };
    return {byte(paint.x()), byte(paint.y()), byte(paint.z()), static_cast<std::uint8_t>(finish)};
  }

  Eigen::Vector3d turned(const Eigen::Vector3d& v) const {
    return Eigen::AngleAxisd(prop_.yaw_rad, Eigen::Vector3d::UnitZ()) * v;
  }

  const world::Prop& prop_;
  std::uint32_t id_;
  Random random_;
  PropMesh mesh_;
  std::vector<std::uint32_t> near_indices_;
  std::vector<std::uint32_t> far_indices_;
};

}  // namespace throng::render
