// The strips of a polygon that its edges sweep while they move inwards: seen from above, the slopes
// of a roof whose ridges are the polygon's straight skeleton (Aichholzer et al. 1995).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace throng::geometry {

/// The ground that an edge sweeps between two moments. A moment is the way of an edge of speed 1.
struct SweptStrip {
  std::size_t edge = 0;  ///< number of the edge's first corner
  /// Ends of the edge before, then after in reverse: counter-clockwise. Equal ones make a triangle.
  std::array<Eigen::Vector2d, 4> corners;
  double from_m = 0;
  double to_m = 0;
};

/// Speeds of all edges from a moment on: 1 for a slope, 0 for an edge that stays where it is, so
/// that its strips have no width (the gable of a roof).
struct EdgeSpeeds {
  double from_m = 0;
  std::vector<double> speeds;
};

/// Moves the edges of a simple, counter-clockwise polygon inwards until nothing is left. `speeds`
/// are in the order of time, the first from 0 on. Neighbors on one line must have one speed.
/// Returns nothing if the polygon defeats the arithmetic: more than 64 corners, corners that
/// coincide, or strips that do not cover it.
std::vector<SweptStrip> sweep_inwards(std::span<const Eigen::Vector2d> polygon,
                                      std::span<const EdgeSpeeds> speeds);

}  // namespace throng::geometry
