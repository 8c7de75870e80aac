// How far a person reaches: what levels of detail keep, so that boxes, keypoints and masks of one
// level fit each other's.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "skinning/body/surface.h"
#include "skinning/population.h"

namespace throng::skinning {

/// How far a mesh reaches, in directions all around, in each of some poses.
class Extent {
 public:
  /// `meshes` are the finest ones of one person, `poses` palettes of that person. What is alpha
  /// tested does not count: most of it is not there.
  Extent(std::span<const Mesh> meshes, std::vector<Palette> poses);

  /// Moves points of a coarser surface of the same person (m, in the rest pose, with weights each)
  /// until they reach as far to within `slack_m`, or as nearly as some rounds achieve; returns how
  /// far off (m) they still are. Simplified surfaces have lost what stands out, such as fingertips
  /// and toes, and where they are fitted by volume, their corners stick out.
  float restore(std::vector<Eigen::Vector3f>& points, const std::vector<BoneWeights>& weights,
                float slack_m) const;

 private:
  struct Reach {
    float far_m;
    Eigen::Vector3f point;  ///< the farthest
  };

  /// The mean of the moves (m) that poses and directions ask a point for; those that are far off
  /// count most.
  struct Move {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float weight = 0;
  };

  /// Adds to `moves` what the points, moved by `matrices`, lack in a pose; returns how far off (m)
  /// they are at most.
  float compare(std::size_t pose, const std::vector<BoneMatrix>& matrices,
                const std::vector<Eigen::Vector3f>& points, float slack_m,
                std::vector<Move>& moves) const;

  std::vector<Palette> poses_;
  std::vector<std::vector<Reach>> reach_;  ///< [pose][direction]
};

}  // namespace throng::skinning
