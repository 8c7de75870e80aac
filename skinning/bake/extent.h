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
  /// `meshes` are the finest ones of one person, `poses` palettes of that person. Parts that are
  /// alpha tested do not count: most of them is not there.
  Extent(std::span<const Mesh> meshes, std::vector<Palette> poses);

  /// Moves points of a coarser surface of the same person (m, in the rest pose, with weights each)
  /// until they reach as far to within `slack_m`, or as nearly as some rounds achieve; returns how
  /// far off (m) they still are. Simplified surfaces have lost what stands out, such as fingertips
  /// and toes, and where they are fitted by volume, their corners stick out. Points that still miss
  /// something become the vertices that they miss, with their weights. Only the first `pose_count`
  /// poses count: a surface of few triangles that is fitted on very different ones collapses.
  float restore(std::vector<Eigen::Vector3f>& points, std::vector<BoneWeights>& weights,
                float slack_m, std::size_t pose_count) const;

 private:
  struct Reach {
    float far_m;
    Eigen::Vector3f point;  ///< the farthest
    Vertex vertex;          ///< the same in the rest pose
  };

  /// A surface while it is moved.
  struct Fit {
    /// The mean of the moves (m) that poses and directions ask a point for; those that are far off
    /// count most.
    struct Move {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      float weight = 0;
      float missing_m = 0;              ///< at most
      const Vertex* missing = nullptr;  ///< what is missing most
    };
    std::vector<Eigen::Vector3f>* points;
    std::vector<BoneWeights>* weights;
    std::vector<std::vector<BoneMatrix>> matrices;  ///< [pose][point]
    std::vector<Move> moves;                        ///< [point]
    std::vector<std::vector<std::size_t>> hot;      ///< [pose]: directions that were far off
    float slack_m;
    std::size_t pose_count;
  };

  using Directions = std::vector<Eigen::Vector3f>;
  using Points = Eigen::Matrix<float, Eigen::Dynamic, 3>;

  /// The points in a pose.
  static Points posed(const Fit& fit, std::size_t pose);
  /// Finds the directions that are far off in all poses, beside those found before; returns how far
  /// off (m) the points are at most.
  float find_hot(Fit& fit) const;
  /// Moves the points by a part of what they lack in these directions; returns how far off (m) they
  /// were.
  float move(Fit& fit, float step) const;
  void compare(Fit& fit, std::size_t pose, float& max_off_m) const;
  /// Replaces points by what they miss by more than the slack.
  void replace(Fit& fit) const;

  std::vector<Palette> poses_;
  std::vector<Directions> directions_;     ///< [pose]: turned from pose to pose
  std::vector<std::vector<Reach>> reach_;  ///< [pose][direction]
};

}  // namespace throng::skinning
