#include "places/imports/parts/loops.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/geometry/polygon.h"

namespace throng::imports {

using Eigen::Vector2d;

namespace {

constexpr std::size_t kMaxCorners = 5'000;
constexpr double kSamePositionM = 1e-3;
constexpr double kMinAreaM2 = 0.01;

/// A point to the millimeter.
using Key = std::pair<std::int64_t, std::int64_t>;
Key point_key(const Vector2d& p) {
  return {std::llround(p.x() / kSamePositionM), std::llround(p.y() / kSamePositionM)};
}

// How far along a - b a corner lies on it, as a share; below 0 where it does not.
double corner_share(const Vector2d& a, const Vector2d& b, const Vector2d& corner) {
  const Vector2d way = b - a;
  const double length = way.norm();
  if (length < kSamePositionM) return -1;
  const double along = (corner - a).dot(way) / length;
  const bool on = along > 0 && along < length &&
                  std::abs(geometry::cross(way, corner - a)) / length < kSamePositionM;
  return on ? along / length : -1;
}

// The same for the point where c - d crosses a - b.
double crossing_fraction(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                         const Vector2d& d) {
  const double turn = geometry::cross(b - a, d - c);
  if (std::abs(turn) < 1e-12) return -1;
  const double share = geometry::cross(c - a, d - c) / turn;
  const double other = geometry::cross(c - a, b - a) / turn;
  return share > 0 && share < 1 && other > 0 && other < 1 ? share : -1;
}

// The ring with a corner wherever two edges meet.
Corners with_crossings(const Corners& ring) {
  Corners all;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % ring.size()];
    std::vector<std::pair<double, Vector2d>> on;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vector2d& c = ring[k];
      const Vector2d& d = ring[(k + 1) % ring.size()];
      if (std::min(c.x(), d.x()) > std::max(a.x(), b.x()) + kSamePositionM ||
          std::max(c.x(), d.x()) < std::min(a.x(), b.x()) - kSamePositionM) {
        continue;
      }
      if (const double share = corner_share(a, b, c); share > 0) on.emplace_back(share, c);
      // The same point of both edges, whichever comes first.
      const bool first = i < k;
      const double share = first ? crossing_fraction(a, b, c, d) : crossing_fraction(c, d, a, b);
      if (share <= 0) continue;
      const Vector2d point = first ? Vector2d(a + share * (b - a)) : Vector2d(c + share * (d - c));
      on.emplace_back((point - a).norm() / (b - a).norm(), point);
    }
    std::sort(on.begin(), on.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    all.push_back(a);
    for (const auto& [share, point] : on) all.push_back(point);
  }
  return all;
}

void keep(Corners loop, std::vector<Corners>& loops) {
  if (loop.size() < 3) return;
  const double size = geometry::signed_area(loop);
  if (std::abs(size) < kMinAreaM2) return;
  if (size < 0) std::reverse(loop.begin(), loop.end());
  loops.push_back(std::move(loop));
}

}  // namespace

std::vector<Corners> simple_loops(const Corners& ring) {
  if (ring.size() < 3 || ring.size() > kMaxCorners) return {};
  std::vector<Corners> loops;
  Corners walked;
  std::map<Key, std::size_t> been;
  for (const Vector2d& corner : with_crossings(ring)) {
    const auto before = been.find(point_key(corner));
    if (before != been.end()) {
      const auto from = walked.begin() + static_cast<std::ptrdiff_t>(before->second);
      for (auto gone = from + 1; gone != walked.end(); ++gone) been.erase(point_key(*gone));
      keep(Corners(from, walked.end()), loops);
      walked.erase(from + 1, walked.end());
    } else {
      been.emplace(point_key(corner), walked.size());
      walked.push_back(corner);
    }
  }
  keep(std::move(walked), loops);
  return loops;
}

}  // namespace throng::imports
