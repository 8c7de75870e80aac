#include "skinning/bake/hull.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "base/geometry/angle.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

namespace {

// Legs that touch would grow together; the arms are apart in the A-pose.
Palette legs_apart(const DressedPerson& person) {
  constexpr double kApartRad = 8 * kDegree;
  Joints a_pose;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const BoneMatrix& matrix = person.to_neutral[bone];
    a_pose[bone] =
        matrix.leftCols<3>().transpose() * (person.joints[bone] - matrix.col(3));  // it is rigid
  }
  Pose pose;
  for (std::size_t bone = index_from(Bone::left_thigh); bone <= index_from(Bone::left_toe);
       ++bone) {
    pose.rotation[bone] = turn_x(kApartRad);
  }
  for (std::size_t bone = index_from(Bone::right_thigh); bone <= index_from(Bone::right_toe);
       ++bone) {
    pose.rotation[bone] = turn_x(-kApartRad);
  }
  return pose_palette(a_pose, pose);
}

std::vector<PosedSurface> posed_by(const Palette& palette, const DressedPerson& person,
                                   const std::map<std::string, Image>& textures) {
  std::vector<PosedSurface> posed;
  for (const Surface& surface : person.surfaces) {
    PosedSurface& one = posed.emplace_back();
    one.surface = &surface;
    one.image = &textures.at(surface.texture);
    one.points.reserve(surface.fitted.size());
    for (std::size_t i = 0; i < surface.fitted.size(); ++i) {
      one.points.push_back(move_point(surface.fitted[i], surface.weights[i], palette));
    }
  }
  return posed;
}

Eigen::Vector3f moved_back(const Eigen::Vector3f& point, const BoneMatrix& matrix) {
  return matrix.leftCols<3>().inverse() * (point - matrix.col(3));
}

// Weighted by the triangles' areas.
std::vector<Eigen::Vector3f> vertex_normals(const std::vector<Eigen::Vector3f>& points,
                                            const std::vector<std::uint32_t>& indices) {
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::Zero());
  for (std::size_t at = 0; at < indices.size(); at += 3) {
    const Eigen::Vector3f& a = points[indices[at]];
    const Eigen::Vector3f normal = (points[indices[at + 1]] - a).cross(points[indices[at + 2]] - a);
    for (std::size_t corner = 0; corner < 3; ++corner) normals[indices[at + corner]] += normal;
  }
  for (Eigen::Vector3f& normal : normals) {
    normal = normal.norm() > 0 ? normal.normalized() : Eigen::Vector3f::UnitZ();
  }
  return normals;
}

ClosedSurface simplified(const ClosedSurface& fine, std::size_t triangles) {
  ClosedSurface coarse;
  const std::size_t target = std::min(3 * triangles, fine.indices.size());
  std::vector<std::uint32_t> indices(fine.indices.size());
  indices.resize(meshopt_simplify(indices.data(), fine.indices.data(), fine.indices.size(),
                                  fine.points.front().data(), fine.points.size(),
                                  sizeof(Eigen::Vector3f), target, 1.0F, 0, nullptr));
  std::map<std::uint32_t, std::uint32_t> place;
  for (const std::uint32_t index : indices) {
    const auto [entry, is_new] =
        place.try_emplace(index, static_cast<std::uint32_t>(coarse.points.size()));
    if (is_new) coarse.points.push_back(fine.points[index]);
    coarse.indices.push_back(entry->second);
  }
  return coarse;
}

/// The volume that a closed surface encloses.
float volume_m3(const std::vector<Eigen::Vector3f>& points,
                const std::vector<std::uint32_t>& indices) {
  float sum = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    sum += points[indices[i]].dot(points[indices[i + 1]].cross(points[indices[i + 2]]));
  }
  return sum / 6;
}

}  // namespace

Hull::Hull(const DressedPerson& person, const std::map<std::string, Image>& textures,
           int image_size)
    : person_(&person),
      apart_(legs_apart(person)),
      posed_(posed_by(apart_, person, textures)),
      portrait_(posed_, image_size),
      carving_(posed_),
      fine_(carving_.surface()) {}

BoneWeights Hull::weights_at(const Eigen::Vector3f& point) const {
  constexpr std::size_t kNearestCount = 4;
  struct Near {
    float squared_m2 = std::numeric_limits<float>::max();
    const BoneWeights* weights = nullptr;
  };
  std::array<Near, kNearestCount> nearest;
  for (const PosedSurface& posed : posed_) {
    if (posed.surface->painted) continue;
    for (const std::uint32_t index : posed.surface->indices) {
      const float squared_m2 = (posed.points[index] - point).squaredNorm();
      if (squared_m2 >= nearest.back().squared_m2) continue;
      const BoneWeights* weights = &posed.surface->weights[index];
      const bool known = std::any_of(nearest.begin(), nearest.end(),
                                     [&](const Near& near) { return near.weights == weights; });
      if (known) continue;
      nearest.back() = {squared_m2, weights};
      std::sort(nearest.begin(), nearest.end(),
                [](const Near& a, const Near& b) { return a.squared_m2 < b.squared_m2; });
    }
  }
  constexpr float kBlurM2 = 1e-4F;
  BoneWeights mean{};
  float sum = 0;
  for (const Near& near : nearest) {
    const float share = 1 / (near.squared_m2 + kBlurM2);
    sum += share;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone)
      mean[bone] += share * (*near.weights)[bone];
  }
  for (float& weight : mean) weight /= sum;
  return mean;
}

// Moves the vertices along their normals until the triangles lie as much outside of the hull as
// inside, so that silhouettes keep their area.
void Hull::fit(ClosedSurface& coarse) const {
  constexpr int kRounds = 6;
  constexpr int kParts =
      4;  // points per edge of a triangle, enough to separate inside from outside
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Eigen::Vector3f> normals = vertex_normals(coarse.points, coarse.indices);
    std::vector<float> outside(coarse.points.size(), 0);
    std::vector<float> total(coarse.points.size(), 0);
    for (std::size_t at = 0; at < coarse.indices.size(); at += 3) {
      const std::uint32_t* corner = &coarse.indices[at];
      const Eigen::Vector3f& a = coarse.points[corner[0]];
      const Eigen::Vector3f ab = coarse.points[corner[1]] - a;
      const Eigen::Vector3f ac = coarse.points[corner[2]] - a;
      const float area = ab.cross(ac).norm();
      for (int i = 0; i < kParts; ++i) {
        for (int j = 0; i + j < kParts; ++j) {
          const float u = (static_cast<float>(i) + 1 / 3.0F) / kParts;
          const float v = (static_cast<float>(j) + 1 / 3.0F) / kParts;
          const float distance = carving_.distance_m(a + u * ab + v * ac);
          const std::array<float, 3> share = {area * (1 - u - v), area * u, area * v};
          for (std::size_t k = 0; k < 3; ++k) {
            outside[corner[k]] += share[k] * distance;
            total[corner[k]] += share[k];
          }
        }
      }
    }
    for (std::size_t i = 0; i < coarse.points.size(); ++i) {
      if (total[i] > 0) coarse.points[i] -= outside[i] / total[i] * normals[i];
    }
  }
}

Hull::Simplified Hull::standing_surface(std::size_t triangles) const {
  Simplified simple;
  simple.surface = simplified(fine_, triangles);
  fit(simple.surface);
  for (const Eigen::Vector3f& point : simple.surface.points) {
    const BoneWeights weights = weights_at(point);
    const Eigen::Vector3f fitted = moved_back(point, mixed(apart_, weights));
    simple.standing.push_back(move_point(fitted, weights, person_->to_neutral));
    simple.standing.back().z() = std::max(simple.standing.back().z(), 0.0F);
    simple.weights.push_back(weights);
  }
  return simple;
}

Mesh Hull::level(std::size_t triangles, int image) const {
  return mesh_of(standing_surface(triangles), image);
}

Mesh Hull::level(std::size_t triangles, int image, const Extent& extent, const Fit& fit) const {
  // A fit that takes this much of the volume has folded the surface.
  constexpr float kMinVolumeShare = 0.6F;
  for (std::size_t count = triangles;; count = std::min(count + count / 4, fit.max_triangles)) {
    const Simplified simple = standing_surface(count);
    Simplified fitted = simple;
    const float off_m =
        extent.restore(fitted.standing, fitted.weights, fit.slack_m, fit.pose_count);
    const bool is_last = count >= fit.max_triangles;
    const bool is_whole = volume_m3(fitted.standing, simple.surface.indices) >=
                          kMinVolumeShare * volume_m3(simple.standing, simple.surface.indices);
    if (is_whole && (off_m <= fit.slack_m || is_last)) return mesh_of(fitted, image);
    if (is_last) return mesh_of(simple, image);
  }
}

Mesh Hull::mesh_of(const Simplified& simple, int image) const {
  const ClosedSurface& coarse = simple.surface;
  const std::vector<Eigen::Vector3f>& standing = simple.standing;
  const std::vector<Eigen::Vector3f> normals = vertex_normals(standing, coarse.indices);
  Mesh mesh;
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> place;
  for (std::size_t at = 0; at < coarse.indices.size(); at += 3) {
    const std::uint32_t* corner = &coarse.indices[at];
    const Eigen::Vector3f& a = coarse.points[corner[0]];
    const bool front = (coarse.points[corner[1]] - a).cross(coarse.points[corner[2]] - a).x() >= 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corner[k];
      const auto [entry, is_new] =
          place.try_emplace({i, front}, static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.indices.push_back(entry->second);
      if (!is_new) continue;
      const Eigen::Vector2f uv = portrait_.uv_of(coarse.points[i], front);
      Vertex vertex{};
      vertex.position = {standing[i].x(), standing[i].y(), standing[i].z()};
      vertex.normal = {normals[i].x(), normals[i].y(), normals[i].z()};
      vertex.uv = {uv.x(), uv.y()};
      set_weights(vertex, simple.weights[i]);
      mesh.vertices.push_back(vertex);
    }
  }
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), image, Tint::portrait,
                        false, image + 1});
  return mesh;
}

}  // namespace throng::skinning
