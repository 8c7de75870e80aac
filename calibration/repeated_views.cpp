#include "calibration/repeated_views.h"

#include <fmt/core.h>

#include <cmath>
#include <map>
#include <tuple>

namespace throng::calibrate {

namespace {

using PixelByPoint = std::map<std::tuple<double, double, double>, Eigen::Vector2d>;

PixelByPoint pixels_by_point(const View& view) {
  PixelByPoint pixels;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const Eigen::Vector3d& point = view.points[i];
    pixels[{point.x(), point.y(), point.z()}] = view.pixels[i];
  }
  return pixels;
}

/// Root mean square distance (px) of the shared points' pixels; infinite where too few are shared.
double distance_px(const PixelByPoint& a, const PixelByPoint& b) {
  double sum = 0;
  std::size_t shared = 0;
  for (const auto& [point, pixel] : a) {
    const auto found = b.find(point);
    if (found == b.end()) continue;
    sum += (found->second - pixel).squaredNorm();
    ++shared;
  }
  if (2 * shared < a.size() || 2 * shared < b.size() || shared == 0) return INFINITY;
  return std::sqrt(sum / static_cast<double>(shared));
}

}  // namespace

std::vector<std::size_t> first_alike(const std::vector<View>& views) {
  std::vector<PixelByPoint> pixels;
  std::vector<std::size_t> first;
  for (std::size_t v = 0; v < views.size(); ++v) {
    pixels.push_back(pixels_by_point(views[v]));
    first.push_back(v);
    for (std::size_t u = 0; u < v; ++u) {
      if (first[u] != u || distance_px(pixels[u], pixels[v]) > kRepeatedPx) continue;
      first[v] = u;
      break;
    }
  }
  return first;
}

std::size_t distinct_views(const std::vector<View>& views) {
  const std::vector<std::size_t> first = first_alike(views);
  std::size_t count = 0;
  for (std::size_t v = 0; v < first.size(); ++v) count += first[v] == v ? 1 : 0;
  return count;
}

void leave_out_copies(Correspondences& all) {
  std::vector<View> kept;
  for (View& view : all.views) {
    const View* copied = nullptr;
    for (const View& other : kept) {
      if (other.points == view.points && other.pixels == view.pixels) copied = &other;
    }
    if (copied == nullptr) {
      kept.push_back(std::move(view));
    } else {
      all.left_out.push_back({view.name, "",
                              fmt::format("the same pixels as in image {}", copied->name),
                              "each image once"});
    }
  }
  all.views = std::move(kept);
}

}  // namespace throng::calibrate
