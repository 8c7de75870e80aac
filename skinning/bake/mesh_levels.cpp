#include "skinning/bake/mesh_levels.h"

#include <meshoptimizer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>

#include "skinning/levels.h"

namespace throng::skinning {

namespace {

Eigen::Vector3f vertex_position(const Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

class Simplifier {
 public:
  explicit Simplifier(const Mesh& mesh) : mesh_(&mesh) {
    weld();
    find_charts();
  }

  Mesh simplified(std::size_t triangles) const {
    const std::vector<std::uint32_t> simple = reduce(triangles);
    std::vector<std::vector<std::uint32_t>> by_part(mesh_->parts.size());
    Mesh result;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    for (std::size_t at = 0; at < simple.size(); at += 3) {
      const std::array<std::uint32_t, 3> corners = {simple[at], simple[at + 1], simple[at + 2]};
      const std::uint32_t chart = chart_for(corners);
      for (const std::uint32_t point : corners) {
        const std::uint32_t vertex = vertex_in(chart, point);
        const auto [entry, is_new] =
            known.try_emplace({vertex, point}, static_cast<std::uint32_t>(result.vertices.size()));
        if (is_new) {
          Vertex copy = mesh_->vertices[copies_[point].front()];
          copy.uv = mesh_->vertices[vertex].uv;
          copy.normal = mesh_->vertices[vertex].normal;
          result.vertices.push_back(copy);
        }
        by_part[part_of_[vertex]].push_back(entry->second);
      }
    }
    for (std::size_t part = 0; part < by_part.size(); ++part) {
      if (by_part[part].empty()) continue;
      Part& added = result.parts.emplace_back(mesh_->parts[part]);
      added.first_index = static_cast<std::uint32_t>(result.indices.size());
      added.index_count = static_cast<std::uint32_t>(by_part[part].size());
      result.indices.insert(result.indices.end(), by_part[part].begin(), by_part[part].end());
    }
    return result;
  }

 private:
  // Vertices of one place become one point.
  void weld() {
    std::map<std::array<float, 3>, std::uint32_t> known;
    for (std::uint32_t i = 0; i < mesh_->vertices.size(); ++i) {
      const auto [entry, is_new] = known.try_emplace(mesh_->vertices[i].position,
                                                     static_cast<std::uint32_t>(copies_.size()));
      if (is_new) {
        copies_.emplace_back();
        points_.push_back(vertex_position(mesh_->vertices[i]));
      }
      copies_[entry->second].push_back(i);
      point_.push_back(entry->second);
    }
    for (std::size_t at = 0; at + 2 < mesh_->indices.size(); at += 3) {
      const std::array<std::uint32_t, 3> corners = {point_[mesh_->indices[at]],
                                                    point_[mesh_->indices[at + 1]],
                                                    point_[mesh_->indices[at + 2]]};
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
        continue;
      }
      welded_.insert(welded_.end(), corners.begin(), corners.end());
    }
  }

  std::uint32_t find_root(std::uint32_t vertex) {
    while (chart_[vertex] != vertex) vertex = chart_[vertex] = chart_[chart_[vertex]];
    return vertex;
  }

  // Triangles that share vertices are one piece of a texture: a chart, named by one vertex.
  void find_charts() {
    chart_.resize(mesh_->vertices.size());
    std::iota(chart_.begin(), chart_.end(), 0);
    part_of_.resize(mesh_->vertices.size(), 0);
    for (std::size_t part = 0; part < mesh_->parts.size(); ++part) {
      const Part& run = mesh_->parts[part];
      for (std::uint32_t at = run.first_index; at < run.first_index + run.index_count; at += 3) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
          part_of_[mesh_->indices[at + corner]] = part;
          chart_[find_root(mesh_->indices[at + corner])] = find_root(mesh_->indices[at]);
        }
      }
    }
    for (std::uint32_t i = 0; i < chart_.size(); ++i) {
      chart_[i] = find_root(i);
      members_[chart_[i]].push_back(i);
    }
  }

  std::vector<std::uint32_t> reduce(std::size_t triangles) const {
    std::vector<std::uint32_t> simple(welded_.size());
    const std::size_t target = std::min(3 * triangles, welded_.size());
    constexpr float kAnyError = 1;
    simple.resize(meshopt_simplify(simple.data(), welded_.data(), welded_.size(),
                                   points_.front().data(), points_.size(), sizeof(Eigen::Vector3f),
                                   target, kAnyError, 0, nullptr));
    if (simple.size() <= target + target / 4) return simple;
    // Many small pieces cannot collapse each on its own.
    simple.resize(welded_.size());
    simple.resize(meshopt_simplifySloppy(simple.data(), welded_.data(), welded_.size(),
                                         points_.front().data(), points_.size(),
                                         sizeof(Eigen::Vector3f), target, kAnyError, nullptr));
    return simple;
  }

  // The chart that most of the corners lie in.
  std::uint32_t chart_for(const std::array<std::uint32_t, 3>& corners) const {
    std::uint32_t best = chart_[copies_[corners[0]].front()];
    int max_count = 0;
    for (const std::uint32_t point : corners) {
      for (const std::uint32_t vertex : copies_[point]) {
        int count = 0;
        for (const std::uint32_t other : corners) count += find_in(chart_[vertex], other) ? 1 : 0;
        if (count <= max_count) continue;
        max_count = count;
        best = chart_[vertex];
      }
    }
    return best;
  }

  const std::uint32_t* find_in(std::uint32_t chart, std::uint32_t point) const {
    const auto& copies = copies_[point];
    const auto found = std::find_if(copies.begin(), copies.end(),
                                    [&](std::uint32_t vertex) { return chart_[vertex] == chart; });
    return found == copies.end() ? nullptr : &*found;
  }

  // The vertex of the chart at a point, or else the one nearest to it.
  std::uint32_t vertex_in(std::uint32_t chart, std::uint32_t point) const {
    if (const std::uint32_t* vertex = find_in(chart, point)) return *vertex;
    std::uint32_t nearest = chart;
    float min_distance = std::numeric_limits<float>::max();
    for (const std::uint32_t vertex : members_.at(chart)) {
      const float distance =
          (vertex_position(mesh_->vertices[vertex]) - points_[point]).squaredNorm();
      if (distance >= min_distance) continue;
      min_distance = distance;
      nearest = vertex;
    }
    return nearest;
  }

  const Mesh* mesh_;
  std::vector<std::uint32_t> point_;                // of each vertex
  std::vector<std::vector<std::uint32_t>> copies_;  // vertices of each point
  std::vector<Eigen::Vector3f> points_;
  std::vector<std::uint32_t> welded_;  // triangles of points
  std::vector<std::uint32_t> chart_;   // of each vertex
  std::map<std::uint32_t, std::vector<std::uint32_t>> members_;
  std::vector<std::size_t> part_of_;
};

Eigen::AlignedBox3f bounding_box(const Mesh& mesh) {
  Eigen::AlignedBox3f bounds;
  for (const Vertex& vertex : mesh.vertices) bounds.extend(vertex_position(vertex));
  return bounds;
}

/// Whether a part that stood out, such as a leg or a hand, has been simplified away.
bool has_lost_limbs(const Mesh& simple, const Mesh& mesh, std::size_t level) {
  const Eigen::AlignedBox3f now = bounding_box(simple);
  const Eigen::AlignedBox3f then = bounding_box(mesh);
  const auto max_shrink_m = static_cast<float>(extent_slack_m(level, then.sizes().z()));
  return (now.min() - then.min()).cwiseAbs().maxCoeff() > max_shrink_m ||
         (now.max() - then.max()).cwiseAbs().maxCoeff() > max_shrink_m;
}

}  // namespace

std::vector<Mesh> simplified_levels(const Mesh& mesh) {
  std::vector<Mesh> levels;
  const Simplifier simplifier(mesh);
  for (const DetailLevel& detail : kDetailLevels) {
    const std::size_t triangles = detail.triangles;
    const Mesh& before = levels.empty() ? mesh : levels.back();
    if (before.indices.size() <= 3 * triangles) {
      levels.push_back(before);
      continue;
    }
    Mesh level = simplifier.simplified(triangles);
    if (level.indices.empty() || has_lost_limbs(level, mesh, levels.size())) level = before;
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace throng::skinning
