#include "render/passes/smooth_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace throng::render {

namespace {

/// How a pixel's color changes.
struct Change {
  std::size_t pixel;
  std::array<std::int16_t, 3> by;
};

/// A straight border between two instances, `length` pixels along `along`, starting beside the
/// pixel `first` of the one and `first + across` of the other.
struct Border {
  std::size_t first;
  std::ptrdiff_t along;
  std::ptrdiff_t across;
  int length;
  bool starts_at_rim;  ///< of the image
  bool ends_at_rim;
};

/// Collects what borders do to the image; all from the colors as they were rendered.
class Smoother {
 public:
  explicit Smoother(Frame& frame) : frame_(frame) {}

  void add(const Border& border) {
    const double before = border.starts_at_rim ? 0 : step(border, 0, -border.along);
    const double after = border.ends_at_rim ? 0 : step(border, border.length - 1, border.along);
    if (before == 0 && after == 0) return;
    const double middle = 0.5 * border.length;
    for (int i = 0; i < border.length; ++i) {
      // The line runs from `before` at the start over 0 in the middle to `after` at the end.
      const double left = before == 0 ? 0 : before * falling_area(i, middle);
      const double right = after == 0 ? 0 : after * falling_area(border.length - 1 - i, middle);
      blend(border, i, left + right);
    }
  }

  void apply() {
    for (const Change& change : changes_) {
      std::uint8_t* rgb = &frame_.rgb[change.pixel * 3];
      for (std::size_t c = 0; c < 3; ++c) {
        rgb[c] = static_cast<std::uint8_t>(std::clamp(rgb[c] + change.by[c], 0, 255));
      }
    }
  }

 private:
  /// Direction of the border beyond its i-th pixel: half a pixel toward the near side, the far
  /// side (negative), or straight.
  double step(const Border& border, int i, std::ptrdiff_t beyond) const {
    const std::size_t near = border.first + static_cast<std::size_t>(i * border.along);
    const std::size_t far = near + static_cast<std::size_t>(border.across);
    const auto& id = frame_.id;
    const bool near_ends = id[near + static_cast<std::size_t>(beyond)] != id[near];
    const bool far_ends = id[far + static_cast<std::size_t>(beyond)] != id[far];
    if (near_ends == far_ends) return 0;
    return near_ends ? 0.5 : -0.5;
  }

  /// Mean over pixel i of a line that falls from 1 to 0 at `middle`.
  static double falling_area(int i, double middle) {
    const double from = 1 - i / middle;
    if (from <= 0) return 0;
    const double to = 1 - (i + 1) / middle;
    return to >= 0 ? 0.5 * (from + to) : 0.5 * from * from * middle;
  }

  void blend(const Border& border, int i, double area) {
    if (area == 0) return;
    const std::size_t near = border.first + static_cast<std::size_t>(i * border.along);
    const std::size_t far = near + static_cast<std::size_t>(border.across);
    const std::size_t to = area > 0 ? near : far;
    const std::size_t from = area > 0 ? far : near;
    Change change{to, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const int difference = frame_.rgb[from * 3 + c] - frame_.rgb[to * 3 + c];
      const double by = std::abs(area) * difference;
      change.by[c] = static_cast<std::int16_t>(by < 0 ? by - 0.5 : by + 0.5);  // rounded
    }
    changes_.push_back(change);
  }

  Frame& frame_;
  std::vector<Change> changes_;
};

/// First x at or after `x` where two rows of ids differ, or `end`. Whole blocks are compared at
/// once: most of an image has no borders.
int next_difference(const std::uint32_t* a, const std::uint32_t* b, int x, int end) {
  constexpr int kBlock = 16;
  while (x + kBlock <= end) {
    std::uint32_t difference = 0;
    for (int i = 0; i < kBlock; ++i) difference |= a[x + i] ^ b[x + i];
    if (difference != 0) break;
    x += kBlock;
  }
  while (x < end && a[x] == b[x]) ++x;
  return x;
}

/// Borders between rows y and y + 1.
void add_row_borders(const Frame& frame, int y, Smoother& smoother) {
  const int width = frame.width();
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  const std::uint32_t* upper = &frame.id[first];
  const std::uint32_t* lower = upper + width;
  for (int x = next_difference(upper, lower, 0, width); x < width;) {
    int end = x + 1;
    while (end < width && upper[end] == upper[x] && lower[end] == lower[x]) ++end;
    smoother.add({first + static_cast<std::size_t>(x), 1, width, end - x, x == 0, end == width});
    x = next_difference(upper, lower, end, width);
  }
}

/// Borders between columns x and x + 1, gathered row by row.
class ColumnBorders {
 public:
  ColumnBorders(const Frame& frame, Smoother& smoother)
      : frame_(frame), smoother_(smoother), top_(static_cast<std::size_t>(frame.width()), kNone) {}

  void add_row(int y) {
    const int width = frame_.width();
    const std::uint32_t* row = &frame_.id[index(0, y)];
    here_.clear();
    for (int x = next_difference(row, row + 1, 0, width - 1); x < width - 1;
         x = next_difference(row, row + 1, x + 1, width - 1)) {
      here_.push_back(x);
      int& top = top_[static_cast<std::size_t>(x)];
      const std::uint32_t* above = row - width;
      if (top != kNone && (above[x] != row[x] || above[x + 1] != row[x + 1])) close(x, y);
      if (top == kNone) top = y;
    }
    // Open segments that are missing here have ended.
    auto still = here_.begin();
    for (const int x : open_) {
      while (still != here_.end() && *still < x) ++still;
      if (still == here_.end() || *still != x) close(x, y);
    }
    std::swap(open_, here_);
  }

  void finish() {
    for (const int x : open_) close(x, frame_.height());
  }

 private:
  static constexpr int kNone = -1;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width()) +
           static_cast<std::size_t>(x);
  }

  void close(int x, int end) {
    int& top = top_[static_cast<std::size_t>(x)];
    smoother_.add({index(x, top), frame_.width(), 1, end - top, top == 0, end == frame_.height()});
    top = kNone;
  }

  const Frame& frame_;
  Smoother& smoother_;
  std::vector<int> top_;  ///< [x] first row of the open border, or kNone
  std::vector<int> open_;
  std::vector<int> here_;
};

}  // namespace

void smooth_edges(Frame& frame) {
  Smoother smoother(frame);
  ColumnBorders columns(frame, smoother);
  for (int y = 0; y < frame.height(); ++y) {
    if (y + 1 < frame.height()) add_row_borders(frame, y, smoother);
    columns.add_row(y);
  }
  columns.finish();
  smoother.apply();
}

}  // namespace throng::render
