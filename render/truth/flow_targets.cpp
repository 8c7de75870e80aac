#include "render/truth/flow_targets.h"

#include <algorithm>
#include <cmath>

#include "base/compute/parallel.h"
#include "base/error.h"

namespace throng::render {

namespace {

// Depth is rounded to centimeters in files; a person's surface in the next frame may be that of
// another level of detail.
constexpr float kMarginM = 0.05F;
constexpr float kMarginShare = 0.002F;
/// Pixels are about a point if they are nearer than this in x and y: four, two where the point is
/// between two middles, and one where it is at a middle, as what stands still before a still
/// camera.
constexpr float kAboutPx = 1 - 1 / 64.0F;
constexpr int kRowsOfTask = 64;

int first_about(float place_px) {
  return std::max(static_cast<int>(std::ceil(place_px - kAboutPx)), 0);
}
int last_about(float place_px, int size_px) {
  return std::min(static_cast<int>(std::floor(place_px + kAboutPx)), size_px - 1);
}

FlowTarget flow_target(const Frame& next, float u, float v, float depth_m) {
  const int width = next.width();
  const int height = next.height();
  // The image covers [-0.5, width - 0.5) in coordinates of pixels' centers.
  const bool is_inside = u >= -0.5F && v >= -0.5F && u < static_cast<float>(width) - 0.5F &&
                         v < static_cast<float>(height) - 0.5F;
  if (!is_inside) return FlowTarget::outside;
  const float margin_m = kMarginM + kMarginShare * depth_m;
  for (int y = first_about(v); y <= last_about(v, height); ++y) {
    for (int x = first_about(u); x <= last_about(u, width); ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x);
      const float shown_m = next.depth_m[pixel];
      // Sky is seen where the image shows sky.
      const bool is_seen =
          std::isinf(depth_m) ? std::isinf(shown_m) : shown_m >= depth_m - margin_m;
      if (is_seen) return FlowTarget::visible;
    }
  }
  return FlowTarget::hidden;
}

}  // namespace

std::vector<std::uint8_t> flow_targets(const Frame& now, const Frame& next) {
  check(now.flow_depth_m.size() == now.id.size() && next.depth_m.size() == now.id.size(),
        "flow and its depth are rendered, and both frames have one size");
  std::vector<std::uint8_t> targets(now.id.size());
  const auto width = static_cast<std::size_t>(now.width());
  parallel_ranges(targets.size(), kRowsOfTask * width, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t row = i / width;
      const float u = static_cast<float>(i - row * width) + now.flow[2 * i];
      const float v = static_cast<float>(row) + now.flow[2 * i + 1];
      const FlowTarget target = std::isnan(u) || std::isnan(v)
                                    ? FlowTarget::unknown
                                    : flow_target(next, u, v, now.flow_depth_m[i]);
      targets[i] = static_cast<std::uint8_t>(target);
    }
  });
  return targets;
}

std::vector<std::uint8_t> unknown_flow_targets(const Frame& now) {
  return std::vector<std::uint8_t>(now.id.size(), static_cast<std::uint8_t>(FlowTarget::unknown));
}

}  // namespace throng::render
