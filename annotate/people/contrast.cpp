#include "annotate/people/contrast.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "annotate/people/cielab.h"

namespace throng::annotate {

namespace {

using Eigen::Vector3f;

/// A mean of colors.
struct Mean {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;

  void add(const Vector3f& color) {
    sum += color.cast<double>();
    ++count;
  }
  Eigen::Vector3d value() const { return sum / std::max(1, count); }
};

double difference(const Mean& a, const Mean& b) {
  return a.count == 0 || b.count == 0 ? 0 : (a.value() - b.value()).norm();
}

/// The object and what is around it, in the image.
class Cutout {
 public:
  Cutout(const ColorImage& image, const render::PixelMask& mask, int margin_px)
      : mask_(&mask),
        box_(Eigen::AlignedBox2i(mask.pixels.min().array() - margin_px,
                                 mask.pixels.max().array() + margin_px)
                 .intersection(Eigen::AlignedBox2i(Eigen::Vector2i::Zero(),
                                                   Eigen::Vector2i(image.width, image.height)))) {
    colors_.reserve(static_cast<std::size_t>(box_.volume()));
    for (int y = box_.min().y(); y < box_.max().y(); ++y) {
      for (int x = box_.min().x(); x < box_.max().x(); ++x) {
        const std::size_t pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
            static_cast<std::size_t>(x);
        colors_.push_back(cielab_of_srgb(image.rgb.data() + 3 * pixel));
      }
    }
  }

  const Eigen::AlignedBox2i& box() const { return box_; }
  bool is_object(int x, int y) const { return mask_->at(x, y); }
  bool contains(int x, int y) const {
    return x >= box_.min().x() && y >= box_.min().y() && x < box_.max().x() && y < box_.max().y();
  }
  const Vector3f& color(int x, int y) const {
    return colors_[static_cast<std::size_t>(y - box_.min().y()) *
                       static_cast<std::size_t>(box_.sizes().x()) +
                   static_cast<std::size_t>(x - box_.min().x())];
  }

 private:
  const render::PixelMask* mask_;
  Eigen::AlignedBox2i box_;
  std::vector<Vector3f> colors_;
};

/// Counts of the object's pixels in rectangles of a cutout, from a table of sums.
class Counts {
 public:
  explicit Counts(const Cutout& cutout)
      : box_(cutout.box()), stride_(static_cast<std::size_t>(box_.sizes().x()) + 1) {
    sums_.assign(stride_ * (static_cast<std::size_t>(box_.sizes().y()) + 1), 0);
    for (int y = box_.min().y(); y < box_.max().y(); ++y) {
      int row = 0;
      for (int x = box_.min().x(); x < box_.max().x(); ++x) {
        row += cutout.is_object(x, y) ? 1 : 0;
        sums_[index(x + 1, y + 1)] = sums_[index(x + 1, y)] + row;
      }
    }
  }

  /// Whether a pixel of the object is at most so far from (x, y), in rows and columns.
  bool is_near(int x, int y, int distance_px) const {
    const int left = std::max(x - distance_px, box_.min().x());
    const int top = std::max(y - distance_px, box_.min().y());
    const int right = std::min(x + distance_px + 1, box_.max().x());
    const int bottom = std::min(y + distance_px + 1, box_.max().y());
    return sums_[index(right, bottom)] - sums_[index(left, bottom)] - sums_[index(right, top)] +
               sums_[index(left, top)] >
           0;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - box_.min().y()) * stride_ +
           static_cast<std::size_t>(x - box_.min().x());
  }

  Eigen::AlignedBox2i box_;
  std::size_t stride_;
  std::vector<int> sums_;
};

double region_contrast(const Cutout& cutout, int margin_px) {
  const Counts counts(cutout);
  Mean inside;
  Mean around;
  const Eigen::AlignedBox2i& box = cutout.box();
  for (int y = box.min().y(); y < box.max().y(); ++y) {
    for (int x = box.min().x(); x < box.max().x(); ++x) {
      if (cutout.is_object(x, y)) {
        inside.add(cutout.color(x, y));
      } else if (counts.is_near(x, y, margin_px)) {
        around.add(cutout.color(x, y));
      }
    }
  }
  return difference(inside, around);
}

/// The difference between the inside and the outside around one pixel of the outline.
double local_contrast(const Cutout& cutout, int x, int y) {
  Mean inside;
  Mean outside;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!cutout.contains(x + dx, y + dy)) continue;
      (cutout.is_object(x + dx, y + dy) ? inside : outside).add(cutout.color(x + dx, y + dy));
    }
  }
  return difference(inside, outside);
}

double edge_contrast(const Cutout& cutout) {
  std::vector<double> differences;
  const Eigen::AlignedBox2i& box = cutout.box();
  for (int y = box.min().y(); y < box.max().y(); ++y) {
    for (int x = box.min().x(); x < box.max().x(); ++x) {
      if (!cutout.is_object(x, y)) continue;
      const auto is_outside = [&](int u, int v) {
        return cutout.contains(u, v) && !cutout.is_object(u, v);
      };
      if (is_outside(x - 1, y) || is_outside(x + 1, y) || is_outside(x, y - 1) ||
          is_outside(x, y + 1)) {
        differences.push_back(local_contrast(cutout, x, y));
      }
    }
  }
  if (differences.empty()) return 0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

}  // namespace

Contrast measure_contrast(const ColorImage& image, const render::PixelMask& mask) {
  if (mask.set.empty()) return {};
  constexpr double kMarginShare = 0.15;
  constexpr int kMinMarginPx = 2;
  constexpr int kMaxMarginPx = 12;
  const int margin_px =
      std::clamp(static_cast<int>(std::lround(kMarginShare * mask.pixels.sizes().y())),
                 kMinMarginPx, kMaxMarginPx);
  const Cutout cutout(image, mask, margin_px);
  return {region_contrast(cutout, margin_px), edge_contrast(cutout)};
}

}  // namespace throng::annotate
