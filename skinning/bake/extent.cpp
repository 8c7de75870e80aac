#include "skinning/bake/extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace throng::skinning {

namespace {

using Eigen::Vector3f;
using Directions = Eigen::Matrix<float, Eigen::Dynamic, 3>;

// Spread evenly over the sphere (a Fibonacci lattice), some 18 degrees apart.
const Directions& directions() {
  static const Directions kAll = [] {
    constexpr int kCount = 120;
    Directions all(kCount, 3);
    for (int i = 0; i < kCount; ++i) {
      const double z = 1 - (2 * i + 1.0) / kCount;
      const double turn = 2 * std::numbers::pi * i / std::numbers::phi;
      const double flat = std::sqrt(1 - z * z);
      all.row(i) =
          Eigen::RowVector3d(flat * std::cos(turn), flat * std::sin(turn), z).cast<float>();
    }
    return all;
  }();
  return kAll;
}

Eigen::Index nearest(const Eigen::Matrix3Xf& points, const Vector3f& to) {
  Eigen::Index found = 0;
  (points.colwise() - to).colwise().squaredNorm().minCoeff(&found);
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

}  // namespace

Extent::Extent(std::span<const Mesh> meshes, std::vector<Palette> poses)
    : poses_(std::move(poses)) {
  const std::vector<const Vertex*> vertices = opaque_vertices(meshes);
  Eigen::Matrix3Xf posed(3, static_cast<Eigen::Index>(vertices.size()));
  for (const Palette& pose : poses_) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      posed.col(static_cast<Eigen::Index>(i)) = skin(*vertices[i], pose, pose, 0);
    }
    const Eigen::MatrixXf along = directions() * posed;
    std::vector<Reach>& reach = reach_.emplace_back();
    for (Eigen::Index d = 0; d < along.rows(); ++d) {
      Eigen::Index vertex = 0;
      const float far_m = along.row(d).maxCoeff(&vertex);
      reach.push_back({far_m, posed.col(vertex)});
    }
  }
}

float Extent::compare(std::size_t pose, const std::vector<BoneMatrix>& matrices,
                      const std::vector<Vector3f>& points, float slack_m,
                      std::vector<Move>& moves) const {
  Eigen::Matrix3Xf posed(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    posed.col(static_cast<Eigen::Index>(i)) = matrices[i] * points[i].homogeneous();
  }
  const Eigen::MatrixXf along = directions() * posed;
  float max_off_m = 0;
  for (Eigen::Index d = 0; d < along.rows(); ++d) {
    const Reach& reach = reach_[pose][static_cast<std::size_t>(d)];
    Eigen::Index point = 0;
    const float off_m = reach.far_m - along.row(d).maxCoeff(&point);
    max_off_m = std::max(max_off_m, std::abs(off_m));
    if (std::abs(off_m) <= 0.5F * slack_m) continue;
    // What is missing is where the finer body ends, not where the coarser one does.
    if (off_m > 0) point = nearest(posed, reach.point);
    const float by_m = reach.far_m - along(d, point);
    Move& move = moves[static_cast<std::size_t>(point)];
    const float weight = off_m * off_m * off_m * off_m;
    const BoneMatrix& matrix = matrices[static_cast<std::size_t>(point)];
    move.sum +=
        weight * by_m * (matrix.leftCols<3>().transpose() * directions().row(d).transpose());
    move.weight += weight;
  }
  return max_off_m;
}

// Each round moves the points by a part of what they lack, and a smaller one, since a point that
// several poses pull at otherwise swings to and fro.
float Extent::restore(std::vector<Vector3f>& points, const std::vector<BoneWeights>& weights,
                      float slack_m) const {
  constexpr int kRounds = 120;
  std::vector<std::vector<BoneMatrix>> matrices;  // [pose][point]
  for (const Palette& pose : poses_) {
    std::vector<BoneMatrix>& of_pose = matrices.emplace_back();
    for (const BoneWeights& own : weights) of_pose.push_back(mixed(pose, own));
  }
  std::vector<Vector3f> best = points;
  float best_m = std::numeric_limits<float>::infinity();
  for (int round = 0; round < kRounds && best_m > slack_m; ++round) {
    std::vector<Move> moves(points.size());
    float max_off_m = 0;
    for (std::size_t pose = 0; pose < poses_.size(); ++pose) {
      max_off_m = std::max(max_off_m, compare(pose, matrices[pose], points, slack_m, moves));
    }
    if (max_off_m < best_m) {
      best_m = max_off_m;
      best = points;
    }
    const float step = 0.7F - 0.6F * static_cast<float>(round) / kRounds;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (moves[i].weight > 0) points[i] += step / moves[i].weight * moves[i].sum;
      // Nobody's soles are below the ground.
      points[i].z() = std::max(points[i].z(), 0.0F);
    }
  }
  points = best;
  return best_m;
}

}  // namespace throng::skinning
