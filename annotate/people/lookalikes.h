// Lookalikes: people in one frame who look alike and are near each other, so that trackers may swap
// their identities.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "annotate/people/contrast.h"

namespace throng::annotate {

/// Mean CIELAB colors of the upper and the lower half of a person's visible pixels.
struct Look {
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
};

/// Min number of visible pixels in each half for a comparison.
inline constexpr int kMinLookPixels = 15;
/// Max CIE 1976 color difference of each half for people who look alike; 2.3 is just noticeable.
inline constexpr double kMaxLookDifference = 6;
/// Max distance of lookalikes in the image, in units of the mean height of their amodal boxes.
inline constexpr double kMaxLookalikeHeights = 3;

/// The look of a person with these visible pixels, halved at the middle of the mask's box.
/// std::nullopt if a half has fewer than kMinLookPixels pixels.
std::optional<Look> describe_look(const ColorImage& image, const render::PixelMask& mask);

/// The greater of the color differences of the two halves.
double look_difference(const Look& a, const Look& b);

/// Look and position of a person in an image.
struct PersonLook {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< center of the amodal box
  double height_px = 0;                                 ///< height of the amodal box
  std::optional<Look> look = std::nullopt;
};

/// For each person, the indices of the lookalikes, nearest first.
std::vector<std::vector<std::size_t>> group_lookalikes(std::span<const PersonLook> people);

}  // namespace throng::annotate
