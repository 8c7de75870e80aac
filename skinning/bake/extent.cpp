#include "skinning/bake/extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace throng::skinning {

namespace {

using Eigen::Vector3f;

// Spread evenly over the sphere (a Fibonacci lattice), some 18 degrees apart, and turned as no
// other pose's are: poses are alike, so that together they tell about all directions.
std::vector<Vector3f> spread_directions(std::size_t pose) {
  constexpr int kCount = 120;
  const auto number = static_cast<double>(pose);
  const Eigen::Quaterniond turn =
      Eigen::AngleAxisd(number, Eigen::Vector3d::UnitX()) *
      Eigen::AngleAxisd(std::numbers::phi * number, Eigen::Vector3d::UnitZ());
  std::vector<Vector3f> all;
  all.reserve(kCount);
  for (int i = 0; i < kCount; ++i) {
    const double z = 1 - (2 * i + 1.0) / kCount;
    const double around = 2 * std::numbers::pi * i / std::numbers::phi;
    const double flat = std::sqrt(1 - z * z);
    const Eigen::Vector3d direction(flat * std::cos(around), flat * std::sin(around), z);
    all.emplace_back((turn * direction).cast<float>());
  }
  return all;
}

auto along(const Eigen::Matrix<float, Eigen::Dynamic, 3>& points, const Vector3f& direction) {
  return points.col(0) * direction.x() + points.col(1) * direction.y() +
         points.col(2) * direction.z();
}

struct Farthest {
  float far_m = 0;
  Eigen::Index point = 0;  ///< the first of those as far
};

// In two passes, since Eigen's search with an index has no vectors.
Farthest farthest(const Eigen::Matrix<float, Eigen::Dynamic, 3>& points,
                  const Vector3f& direction) {
  const Eigen::VectorXf far_m = along(points, direction);
  const float max_m = far_m.maxCoeff();
  return {max_m, std::find(far_m.begin(), far_m.end(), max_m) - far_m.begin()};
}

Eigen::Index nearest(const Eigen::Matrix<float, Eigen::Dynamic, 3>& points, const Vector3f& to) {
  Eigen::Index found = 0;
  (points.rowwise() - to.transpose()).rowwise().squaredNorm().minCoeff(&found);
  return found;
}

// The vertices of parts that are not alpha tested.
std::vector<const Vertex*> opaque_vertices(std::span<const Mesh> meshes) {
  std::vector<const Vertex*> found;
  for (const Mesh& mesh : meshes) {
    std::vector<char> is_known(mesh.vertices.size(), 0);
    for (const Part& part : mesh.parts) {
      for (std::uint32_t at = 0; at < part.index_count && !part.alpha_tested; ++at) {
        const std::uint32_t index = mesh.indices[part.first_index + at];
        if (is_known[index] == 0) found.push_back(&mesh.vertices[index]);
        is_known[index] = 1;
      }
    }
  }
  return found;
}

BoneWeights drawn_weights(const Vertex& vertex) {
  BoneWeights weights{};
  for (std::size_t i = 0; i < vertex.bones.size(); ++i) {
    weights[vertex.bones[i]] += static_cast<float>(vertex.weights[i]) / 255;
  }
  return weights;
}

// Vertices have only some of the bones.
BoneWeights as_drawn(const BoneWeights& weights) {
  Vertex vertex{};
  set_weights(vertex, weights);
  return drawn_weights(vertex);
}

}  // namespace

Extent::Extent(std::span<const Mesh> meshes, std::vector<Palette> poses)
    : poses_(std::move(poses)) {
  const std::vector<const Vertex*> vertices = opaque_vertices(meshes);
  Points points(static_cast<Eigen::Index>(vertices.size()), 3);
  for (const Palette& pose : poses_) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      points.row(static_cast<Eigen::Index>(i)) = skin(*vertices[i], pose, pose, 0).transpose();
    }
    const Directions& directions = directions_.emplace_back(spread_directions(directions_.size()));
    std::vector<Reach>& reach = reach_.emplace_back();
    for (const Vector3f& direction : directions) {
      const auto [far_m, vertex] = farthest(points, direction);
      reach.push_back(
          {far_m, points.row(vertex).transpose(), *vertices[static_cast<std::size_t>(vertex)]});
    }
  }
}

Extent::Points Extent::posed(const Fit& fit, std::size_t pose) {
  const std::vector<Vector3f>& points = *fit.points;
  Points posed(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BoneMatrix& matrix = fit.matrices[pose][i];
    posed.row(static_cast<Eigen::Index>(i)) =
        (matrix.leftCols<3>() * points[i] + matrix.col(3)).transpose();
  }
  return posed;
}

float Extent::find_hot(Fit& fit) const {
  constexpr float kHotShare = 0.6F;
  float max_off_m = 0;
  for (std::size_t pose = 0; pose < fit.pose_count; ++pose) {
    const Points points = posed(fit, pose);
    std::vector<std::size_t>& hot = fit.hot[pose];
    for (std::size_t d = 0; d < directions_[pose].size(); ++d) {
      const float far_m = along(points, directions_[pose][d]).maxCoeff();
      const float off_m = std::abs(reach_[pose][d].far_m - far_m);
      max_off_m = std::max(max_off_m, off_m);
      if (off_m > kHotShare * fit.slack_m && std::find(hot.begin(), hot.end(), d) == hot.end()) {
        hot.push_back(d);
      }
    }
  }
  return max_off_m;
}

void Extent::compare(Fit& fit, std::size_t pose, float& max_off_m) const {
  const Points points = posed(fit, pose);
  for (const std::size_t d : fit.hot[pose]) {
    const Vector3f& direction = directions_[pose][d];
    const Reach& reach = reach_[pose][d];
    auto [far_m, point] = farthest(points, direction);
    const float off_m = reach.far_m - far_m;
    max_off_m = std::max(max_off_m, std::abs(off_m));
    if (std::abs(off_m) <= 0.5F * fit.slack_m) continue;
    // The missing part is where the finer body ends, not where the coarser one does.
    if (off_m > 0) point = nearest(points, reach.point);
    const float by_m = reach.far_m - points.row(point).dot(direction.transpose());
    const auto at = static_cast<std::size_t>(point);
    const float weight = off_m * off_m * off_m * off_m;
    Fit::Move& move = fit.moves[at];
    move.sum += weight * by_m * (fit.matrices[pose][at].leftCols<3>().transpose() * direction);
    move.weight += weight;
    if (off_m > move.missing_m) {
      move.missing_m = off_m;
      move.missing = &reach.vertex;
    }
  }
}

float Extent::move(Fit& fit, float step) const {
  std::vector<Vector3f>& points = *fit.points;
  fit.moves.assign(points.size(), {});
  float max_off_m = 0;
  for (std::size_t pose = 0; pose < fit.pose_count; ++pose) {
    if (!fit.hot[pose].empty()) compare(fit, pose, max_off_m);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Fit::Move& move = fit.moves[i];
    if (move.weight > 0) points[i] += step / move.weight * move.sum;
    // Nobody's soles are below the ground.
    points[i].z() = std::max(points[i].z(), 0.0F);
  }
  return max_off_m;
}

void Extent::replace(Fit& fit) const {
  for (std::size_t i = 0; i < fit.moves.size(); ++i) {
    const Fit::Move& move = fit.moves[i];
    if (move.missing_m <= fit.slack_m) continue;
    (*fit.points)[i] = Vector3f(move.missing->position.data());
    (*fit.weights)[i] = drawn_weights(*move.missing);
    for (std::size_t pose = 0; pose < fit.pose_count; ++pose) {
      fit.matrices[pose][i] = mixed(poses_[pose], (*fit.weights)[i]);
    }
  }
}

// Each round moves the points by a part of what they lack, and a smaller one, since a point that
// several poses pull at otherwise swings to and fro. Most rounds look only at the directions that
// were found to be far off.
float Extent::restore(std::vector<Vector3f>& points, std::vector<BoneWeights>& weights,
                      float slack_m, std::size_t pose_count) const {
  constexpr int kSearches = 8;
  constexpr int kRounds = 16;  // after each search
  Fit fit{&points, &weights, {}, {}, {}, slack_m, std::min(pose_count, poses_.size())};
  fit.hot.resize(fit.pose_count);
  for (BoneWeights& own : weights) own = as_drawn(own);
  for (std::size_t pose = 0; pose < fit.pose_count; ++pose) {
    std::vector<BoneMatrix>& of_pose = fit.matrices.emplace_back();
    for (const BoneWeights& own : weights) of_pose.push_back(mixed(poses_[pose], own));
  }
  std::vector<Vector3f> best = points;
  std::vector<BoneWeights> best_weights = weights;
  float best_m = find_hot(fit);
  for (int search = 0; search < kSearches && best_m > slack_m; ++search) {
    if (search == 2 || search == 4) replace(fit);
    std::vector<Vector3f> best_round = points;
    float best_round_m = std::numeric_limits<float>::infinity();
    for (int round = 0; round < kRounds && best_round_m > 0.9F * slack_m; ++round) {
      const float done = static_cast<float>(search * kRounds + round) / (kSearches * kRounds);
      std::vector<Vector3f> before = points;
      const float off_m = move(fit, 0.7F - 0.6F * done);
      if (off_m < best_round_m) {
        best_round_m = off_m;
        best_round = std::move(before);
      }
    }
    points = best_round;
    const float off_m = find_hot(fit);
    if (off_m < best_m) {
      best_m = off_m;
      best = points;
      best_weights = weights;
    }
  }
  points = best;
  weights = best_weights;
  return best_m;
}

}  // namespace throng::skinning
