#include "render/lens/depth_between.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace throng::render {

namespace {

/// How 1 / z changes from a pixel to the one a step away, if that shows the same surface.
class Slopes {
 public:
  Slopes(const Frame& image, const Eigen::Vector2i& at) : image_(image), at_(at) {
    id_ = image.id[pixel_index(at)];
    inverse_ = 1 / image.depth_m[pixel_index(at)];
  }

  float inverse() const { return inverse_; }

  /// The change along an axis: the smaller one of both sides, since at an edge within the object
  /// the other one leads elsewhere.
  float along(const Eigen::Vector2i& step) const {
    const std::optional<float> ahead = towards(step);
    std::optional<float> behind = towards(-step);
    if (behind) behind = -*behind;
    if (ahead && behind) return std::abs(*ahead) < std::abs(*behind) ? *ahead : *behind;
    return ahead.value_or(behind.value_or(0.0F));
  }

 private:
  std::size_t pixel_index(const Eigen::Vector2i& at) const {
    return static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(image_.width()) +
           static_cast<std::size_t>(at.x());
  }

  std::optional<float> towards(const Eigen::Vector2i& step) const {
    const Eigen::Vector2i next = at_ + step;
    const bool is_inside =
        next.x() >= 0 && next.y() >= 0 && next.x() < image_.width() && next.y() < image_.height();
    if (!is_inside || image_.id[pixel_index(next)] != id_) return std::nullopt;
    const float change = 1 / image_.depth_m[pixel_index(next)] - inverse_;
    // A body's or prop's other part behind its edge. The ground and buildings have one surface in a
    // pixel and its neighbors, however steeply they lead away.
    constexpr float kOneSurface = 0.02F;
    const bool is_even = id_ == kIdGround || (id_ >= kIdBuilding && id_ < kIdProp);
    if (!is_even && std::abs(change) > kOneSurface * inverse_) return std::nullopt;
    return change;
  }

  const Frame& image_;
  Eigen::Vector2i at_;
  std::uint32_t id_;
  float inverse_;
};

}  // namespace

float depth_between(const Frame& image, const Eigen::Vector2i& near, const Eigen::Vector2f& off) {
  const std::size_t pixel =
      static_cast<std::size_t>(near.y()) * static_cast<std::size_t>(image.width()) +
      static_cast<std::size_t>(near.x());
  const float here = image.depth_m[pixel];
  if (!std::isfinite(here)) return here;
  const Slopes slopes(image, near);
  const float inverse =
      slopes.inverse() + off.x() * slopes.along({1, 0}) + off.y() * slopes.along({0, 1});
  return inverse > 0 ? 1 / inverse : here;
}

}  // namespace throng::render
