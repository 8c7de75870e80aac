#include "annotate/people/lookalikes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "annotate/people/cielab.h"

namespace throng::annotate {

std::optional<Look> describe_look(const ColorImage& image, const render::PixelMask& mask) {
  Look look;
  int upper = 0;
  int lower = 0;
  const Eigen::AlignedBox2i& box = mask.pixels;
  for (int y = box.min().y(); y < box.max().y(); ++y) {
    const bool is_upper = 2 * y + 1 < box.min().y() + box.max().y();
    for (int x = box.min().x(); x < box.max().x(); ++x) {
      if (!mask.at(x, y)) continue;
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(x);
      (is_upper ? look.upper : look.lower) +=
          cielab_of_srgb(image.rgb.data() + 3 * pixel).cast<double>();
      ++(is_upper ? upper : lower);
    }
  }
  if (std::min(upper, lower) < kMinLookPixels) return std::nullopt;
  look.upper /= upper;
  look.lower /= lower;
  return look;
}

double look_difference(const Look& a, const Look& b) {
  return std::max((a.upper - b.upper).norm(), (a.lower - b.lower).norm());
}

namespace {

bool are_comparable(const PersonLook& a, const PersonLook& b) {
  const double limit_px = kMaxLookalikeHeights * 0.5 * (a.height_px + b.height_px);
  return a.look && b.look && (a.center_px - b.center_px).norm() <= limit_px;
}

}  // namespace

std::vector<std::vector<std::size_t>> group_lookalikes(std::span<const PersonLook> people) {
  // From left to right, so that only neighbors are compared.
  std::vector<std::size_t> order(people.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return people[a].center_px.x() < people[b].center_px.x();
  });
  double tallest_px = 0;
  for (const PersonLook& person : people) tallest_px = std::max(tallest_px, person.height_px);
  std::vector<std::vector<std::pair<double, std::size_t>>> found(people.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const PersonLook& a = people[order[i]];
    const double last_px = a.center_px.x() + kMaxLookalikeHeights * tallest_px;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const PersonLook& b = people[order[j]];
      if (b.center_px.x() > last_px) break;
      if (!are_comparable(a, b) || look_difference(*a.look, *b.look) > kMaxLookDifference) continue;
      const double distance_px = (a.center_px - b.center_px).norm();
      found[order[i]].emplace_back(distance_px, order[j]);
      found[order[j]].emplace_back(distance_px, order[i]);
    }
  }
  std::vector<std::vector<std::size_t>> lookalikes(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    std::sort(found[i].begin(), found[i].end());
    for (const auto& [distance_px, other] : found[i]) lookalikes[i].push_back(other);
  }
  return lookalikes;
}

}  // namespace throng::annotate
