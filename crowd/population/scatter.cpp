#include "crowd/population/scatter.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace throng::crowd {

using Eigen::Vector2f;

namespace {

/// Positions in square cells as wide as two positions have to be apart.
class Positions {
 public:
  explicit Positions(float apart_m) : apart_m_(apart_m) {}

  void add(const Vector2f& place) {
    cells_[key(column(place.x()), column(place.y()))].push_back(place);
  }

  bool has_room(const Vector2f& place) const {
    const std::int64_t x = column(place.x());
    const std::int64_t y = column(place.y());
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto cell = cells_.find(key(x + dx, y + dy));
        if (cell == cells_.end()) continue;
        for (const Vector2f& other : cell->second) {
          if ((other - place).squaredNorm() < apart_m_ * apart_m_) return false;
        }
      }
    }
    return true;
  }

 private:
  std::int64_t column(float m) const { return static_cast<std::int64_t>(std::floor(m / apart_m_)); }
  static std::int64_t key(std::int64_t x, std::int64_t y) {
    constexpr std::int64_t kColumns = std::int64_t{1} << 31;
    return x * kColumns + y;
  }

  float apart_m_;
  std::unordered_map<std::int64_t, std::vector<Vector2f>> cells_;
};

/// Makes neighbors on the ground neighbors in memory, for locality of planning and neighbor search:
/// strip by strip, along each.
void sort_by_strips(std::vector<Vector2f>& places) {
  constexpr float kStripM = 4;
  std::sort(places.begin(), places.end(), [](const Vector2f& a, const Vector2f& b) {
    const float strip_a = std::floor(a.y() / kStripM);
    const float strip_b = std::floor(b.y() / kStripM);
    if (strip_a != strip_b) return strip_a < strip_b;
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
}

}  // namespace

std::vector<Vector2f> scatter(const ScatterSpec& spec, const Obstacles& walls,
                              std::span<const Vector2f> taken, Random random) {
  constexpr int kMaxMisses = 5000;  // in a row
  Obstacles area;
  area.add_polygon(spec.area, 1);
  const Polygon& outline = area.polygons().front();
  const auto& [min, max] = outline.bounds;
  Positions all(spec.apart_m);
  for (const Vector2f& place : taken) all.add(place);
  const auto is_free = [&](const Vector2f& place) {
    return area.encloses(outline, place) && all.has_room(place) &&
           walls.is_clear(place, spec.clearance_m, spec.obstacle_mask);
  };
  std::vector<Vector2f> places;
  for (int misses = 0; places.size() < spec.count && misses < kMaxMisses; ++misses) {
    const double x = random.uniform(min.x(), max.x());
    const double y = random.uniform(min.y(), max.y());
    const Vector2f place(static_cast<float>(x), static_cast<float>(y));
    if (!is_free(place)) continue;
    all.add(place);
    places.push_back(place);
    misses = -1;
  }
  sort_by_strips(places);
  return places;
}

}  // namespace throng::crowd
