// People of one frame who look alike and are near each other: where trackers exchange identities.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "annotate/people/contrast.h"

namespace throng::annotate {

/// Mean CIELAB colors of the upper and the lower half of what an image shows of somebody.
struct Look {
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
};

/// Below this, halves have no color that could be compared.
inline constexpr int kMinLookPixels = 15;
/// CIE 1976 color difference of each half below which people look alike; 2.3 is just noticeable.
inline constexpr double kMaxLookDifference = 6;
/// How far apart people are compared, in the mean of the heights of their whole boxes.
inline constexpr double kMaxLookalikeHeights = 3;

/// Halves are those of the mask's box. Nothing if one has less than kMinLookPixels pixels.
std::optional<Look> describe_look(const ColorImage& image, const render::PixelMask& mask);

/// The larger one of the color differences of the halves.
double look_difference(const Look& a, const Look& b);

/// Look and place of a person in an image, for comparisons.
struct PersonLook {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< of the whole box
  double height_px = 0;                                 ///< of the whole box
  std::optional<Look> look = std::nullopt;
};

/// For each person the indices of those who look alike and are near, the nearest first.
std::vector<std::vector<std::size_t>> group_lookalikes(std::span<const PersonLook> people);

}  // namespace throng::annotate
