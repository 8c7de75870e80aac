#include "skinning/hull.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

namespace throng::skinning {

namespace {

using Triangles = std::vector<std::uint32_t>;

// Closes every hole of a triangle mesh with a fan about its first vertex.
void close_holes(Triangles& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t at = 0; at < triangles.size(); at += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      edges.emplace(triangles[at + corner], triangles[at + (corner + 1) % 3]);
    }
  }
  std::map<std::uint32_t, std::uint32_t> next;  // along the border, the way a closing face runs
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) next[to] = from;
  }
  while (!next.empty()) {
    std::vector<std::uint32_t> loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      loop.push_back(at->second);
      next.erase(at);
    }
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      triangles.insert(triangles.end(), {loop[0], loop[i], loop[i + 1]});
    }
  }
}

std::vector<Eigen::Vector3f> vertex_normals(const std::vector<Eigen::Vector3f>& positions,
                                            const Triangles& indices) {
  std::vector<Eigen::Vector3f> normals(positions.size(), Eigen::Vector3f::Zero());
  for (std::size_t at = 0; at < indices.size(); at += 3) {
    const Eigen::Vector3f& a = positions[indices[at]];
    const Eigen::Vector3f normal =
        (positions[indices[at + 1]] - a).cross(positions[indices[at + 2]] - a);
    for (std::size_t corner = 0; corner < 3; ++corner) normals[indices[at + corner]] += normal;
  }
  for (Eigen::Vector3f& normal : normals) {
    normal = normal.norm() > 0 ? normal.normalized() : Eigen::Vector3f::UnitZ();
  }
  return normals;
}

BoneWeights mixed(const BoneWeights& a, const BoneWeights& b, float t) {
  BoneWeights weights;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    weights[bone] = (1 - t) * a[bone] + t * b[bone];
  }
  return weights;
}

// A person's skin in the A-pose with what lies over it, refined until no triangle reaches across
// the border of a garment.
class HullBuilder {
 public:
  HullBuilder(const MakeHuman& makehuman, const DressedPerson& person, const HullTopology& topology,
              const Clothing& clothing)
      : clothing_(&clothing), swell_m_(topology.swell_m) {
    for (const std::uint32_t vertex : topology.vertices) {
      points_.push_back(person.body[vertex]);
      weights_.push_back(makehuman.weights()[vertex]);
    }
    normals_ = vertex_normals(points_, topology.indices);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      covers_.push_back(clothing.over(points_[i], normals_[i], weights_[i]));
    }
    for (std::size_t at = 0; at < topology.indices.size(); at += 3) {
      cut({topology.indices[at], topology.indices[at + 1], topology.indices[at + 2]});
    }
  }

  Mesh mesh(const DressedPerson& person, const Portrait& portrait, int picture) const {
    std::vector<Eigen::Vector3f> fitted(points_.size());
    std::vector<Eigen::Vector3f> standing(points_.size());
    Triangles all;
    for (const auto& [unused, triangles] : by_tint_) {
      all.insert(all.end(), triangles.begin(), triangles.end());
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      fitted[i] = points_[i] + (covers_[i].distance_m + swell_m_) * normals_[i];
      standing[i] = move_point(fitted[i], weights_[i], person.to_neutral);
      standing[i].z() = std::max(standing[i].z(), 0.0F);
    }
    const std::vector<Eigen::Vector3f> normals = vertex_normals(standing, all);
    Mesh mesh;
    for (const auto& [tint, triangles] : by_tint_) {
      const auto first_index = static_cast<std::uint32_t>(mesh.indices.size());
      std::map<std::pair<std::uint32_t, bool>, std::uint32_t> place;
      for (std::size_t at = 0; at < triangles.size(); at += 3) {
        const Eigen::Vector3f& a = fitted[triangles[at]];
        const Eigen::Vector3f face =
            (fitted[triangles[at + 1]] - a).cross(fitted[triangles[at + 2]] - a);
        const bool front = face.x() >= 0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const std::uint32_t i = triangles[at + corner];
          const auto [entry, is_new] =
              place.try_emplace({i, front}, static_cast<std::uint32_t>(mesh.vertices.size()));
          mesh.indices.push_back(entry->second);
          if (!is_new) continue;
          const Eigen::Vector2f uv = portrait.uv_of(fitted[i], front);
          Vertex vertex{};
          vertex.position = {standing[i].x(), standing[i].y(), standing[i].z()};
          vertex.normal = {normals[i].x(), normals[i].y(), normals[i].z()};
          vertex.uv = {uv.x(), uv.y()};
          set_weights(vertex, weights_[i]);
          mesh.vertices.push_back(vertex);
        }
      }
      mesh.parts.push_back({first_index,
                            static_cast<std::uint32_t>(mesh.indices.size()) - first_index,
                            tint == Tint::none ? picture : picture + 1, tint, false});
    }
    return mesh;
  }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  void emit(Tint tint, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    by_tint_[tint].insert(by_tint_[tint].end(), {a, b, c});
  }

  // Splits a triangle where what lies over it changes, along a line between two of its edges.
  void cut(const Corners& corner) {
    const auto tint = [&](std::size_t i) { return covers_[corner[i]].tint; };
    if (tint(0) == tint(1) && tint(1) == tint(2)) {
      emit(tint(0), corner[0], corner[1], corner[2]);
      return;
    }
    for (std::size_t apex = 0; apex < 3; ++apex) {
      const std::size_t left = (apex + 1) % 3;
      const std::size_t right = (apex + 2) % 3;
      if (tint(left) != tint(right)) continue;
      const std::uint32_t a = corner[apex];
      const std::uint32_t b = corner[left];
      const std::uint32_t c = corner[right];
      const std::uint32_t ab = border_between(a, b);
      const std::uint32_t ac = border_between(a, c);
      emit(tint(apex), a, ab, ac);
      emit(tint(left), ab, b, c);
      emit(tint(left), ab, c, ac);
      return;
    }
    // Three things meet: each gets the corner where it is, the rest goes to the first.
    const std::uint32_t ab = border_between(corner[0], corner[1]);
    const std::uint32_t bc = border_between(corner[1], corner[2]);
    const std::uint32_t ca = border_between(corner[2], corner[0]);
    emit(tint(0), corner[0], ab, ca);
    emit(tint(1), ab, corner[1], bc);
    emit(tint(2), ca, bc, corner[2]);
    emit(tint(0), ab, bc, ca);
  }

  // The vertex on an edge where what lies over it changes; one for both triangles at the edge.
  std::uint32_t border_between(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from = std::min(a, b);
    const std::uint32_t to = std::max(a, b);
    const auto [entry, is_new] =
        borders_.try_emplace({from, to}, static_cast<std::uint32_t>(points_.size()));
    if (!is_new) return entry->second;
    float low = 0;
    float high = 1;
    Cover before = covers_[from];
    Cover after = covers_[to];
    constexpr int kSteps = 5;
    for (int step = 0; step < kSteps; ++step) {
      const float middle = 0.5F * (low + high);
      const Cover cover = clothing_->over(point_on(from, to, middle), normal_on(from, to, middle),
                                          mixed(weights_[from], weights_[to], middle));
      if (cover.tint == covers_[from].tint) {
        low = middle;
        before = cover;
      } else {
        high = middle;
        after = cover;
      }
    }
    const float t = 0.5F * (low + high);
    points_.push_back(point_on(from, to, t));
    normals_.push_back(normal_on(from, to, t));
    weights_.push_back(mixed(weights_[from], weights_[to], t));
    covers_.push_back(before.distance_m > after.distance_m ? before : after);
    return entry->second;
  }

  Eigen::Vector3f point_on(std::uint32_t a, std::uint32_t b, float t) const {
    return (1 - t) * points_[a] + t * points_[b];
  }
  Eigen::Vector3f normal_on(std::uint32_t a, std::uint32_t b, float t) const {
    return ((1 - t) * normals_[a] + t * normals_[b]).normalized();
  }

  const Clothing* clothing_;
  float swell_m_;
  std::vector<Eigen::Vector3f> points_;  // on the skin
  std::vector<Eigen::Vector3f> normals_;
  std::vector<BoneWeights> weights_;
  std::vector<Cover> covers_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> borders_;
  std::map<Tint, Triangles> by_tint_;
};

}  // namespace

HullTopology simplify_skin(const MakeHuman& makehuman, std::size_t triangles, float swell_m) {
  Triangles all;
  for (const Quad& quad : makehuman.skin()) {
    for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) all.push_back(quad.vertex[corner]);
  }
  close_holes(all);
  const std::vector<Eigen::Vector3f>& positions = makehuman.base_positions();
  Triangles simple(all.size());
  const std::size_t target = std::min(3 * triangles, all.size());
  simple.resize(meshopt_simplify(simple.data(), all.data(), all.size(), positions.front().data(),
                                 positions.size(), sizeof(Eigen::Vector3f), target, 1.0F, 0,
                                 nullptr));
  HullTopology topology;
  topology.swell_m = swell_m;
  std::map<std::uint32_t, std::uint32_t> place;
  for (const std::uint32_t vertex : simple) {
    const auto [entry, is_new] =
        place.try_emplace(vertex, static_cast<std::uint32_t>(topology.vertices.size()));
    if (is_new) topology.vertices.push_back(vertex);
    topology.indices.push_back(entry->second);
  }
  return topology;
}

Mesh make_hull(const MakeHuman& makehuman, const DressedPerson& person,
               const HullTopology& topology, const Portrait& portrait, const Clothing& clothing,
               int picture) {
  return HullBuilder(makehuman, person, topology, clothing).mesh(person, portrait, picture);
}

}  // namespace throng::skinning
