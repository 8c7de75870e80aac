#include "base/geometry/straight_skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/geometry/polygon.h"

namespace throng::geometry {

namespace {

using Eigen::Vector2d;

constexpr double kSameM = 1e-7;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// A corner of the moving outline and the edge that begins there, with where that edge was when its
/// strip began.
struct Corner {
  Vector2d position;
  std::size_t edge = 0;
  Vector2d strip_from;
  Vector2d strip_to;
  double strip_from_m = 0;
};

using Loop = std::vector<Corner>;

class Sweep {
 public:
  explicit Sweep(std::span<const Vector2d> polygon) {
    Loop loop;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d& next = polygon[(i + 1) % polygon.size()];
      const Vector2d along = (next - polygon[i]).normalized();
      inward_.emplace_back(-along.y(), along.x());
      loop.push_back({polygon[i], i, polygon[i], next, 0});
    }
    loops_.push_back(std::move(loop));
  }

  /// Returns false if it does not end.
  bool run(std::span<const EdgeSpeeds> phases) {
    constexpr int kMaxEvents = 400;
    std::size_t phase = 0;
    speeds_ = phases[0].speeds;
    for (int event = 0; event < kMaxEvents; ++event) {
      for (std::size_t i = 0; i < loops_.size(); ++i) clean(loops_[i]);
      std::erase_if(loops_, [](const Loop& loop) { return loop.empty(); });
      if (loops_.empty()) return true;
      const double phase_end_m = phase + 1 < phases.size() ? phases[phase + 1].from_m : kNever;
      const Next next = next_event();
      const double wait_m = std::min(next.wait_m, phase_end_m - now_m_);
      if (!std::isfinite(wait_m)) return false;
      advance(wait_m);
      if (next.wait_m <= wait_m) {
        if (next.splits) split(next);
      } else {
        for (Loop& loop : loops_) restart_strips(loop);
        speeds_ = phases[++phase].speeds;
      }
    }
    return false;
  }

  std::vector<SweptStrip> take() { return std::move(strips_); }

 private:
  struct Next {
    double wait_m = kNever;
    std::size_t loop = 0;
    std::size_t corner = 0;
    std::size_t edge = 0;  ///< index in the loop of the edge that the corner hits
    bool splits = false;
  };

  static const Corner& before(const Loop& loop, std::size_t i) {
    return loop[(i + loop.size() - 1) % loop.size()];
  }
  static const Corner& after(const Loop& loop, std::size_t i) {
    return loop[(i + 1) % loop.size()];
  }

  /// The way of a corner: both of its edges move at their speeds. Nothing between edges that run
  /// against each other, where there is no way that both allow.
  std::optional<Vector2d> velocity(const Loop& loop, std::size_t i) const {
    const std::size_t a = before(loop, i).edge;
    const std::size_t b = loop[i].edge;
    const double turn = cross(inward_[a], inward_[b]);
    if (std::abs(turn) < 1e-6) {
      if (inward_[a].dot(inward_[b]) < 0) return std::nullopt;
      return Vector2d(speeds_[b] * inward_[b]);
    }
    const Vector2d& n = inward_[a];
    const Vector2d& m = inward_[b];
    return Vector2d((speeds_[a] * m.y() - speeds_[b] * n.y()) / turn,
                    (speeds_[b] * n.x() - speeds_[a] * m.x()) / turn);
  }

  bool is_reflex(const Loop& loop, std::size_t i) const {
    return cross(inward_[before(loop, i).edge], inward_[loop[i].edge]) < -1e-9;
  }

  void look_at_edge(const Loop& loop, std::size_t i, std::size_t number, Next& next) const {
    const auto first = velocity(loop, i);
    const auto second = velocity(loop, (i + 1) % loop.size());
    if (!first || !second) return;
    const Vector2d edge = after(loop, i).position - loop[i].position;
    const double closing = (*first - *second).dot(edge.normalized());
    if (closing <= 1e-12) return;
    const double wait_m = edge.norm() / closing;
    if (wait_m < next.wait_m) next = {wait_m, number, i, i, false};
  }

  /// Whether a corner that points into the outline hits edge `k` of its loop.
  void look_at_split(const Loop& loop, std::size_t i, std::size_t k, std::size_t number,
                     Next& next) const {
    if (k == i || k == (i + loop.size() - 1) % loop.size()) return;
    const auto way = velocity(loop, i);
    const auto first = velocity(loop, k);
    const auto second = velocity(loop, (k + 1) % loop.size());
    if (!way || !first || !second) return;
    const Vector2d& n = inward_[loop[k].edge];
    const double distance_m = (loop[i].position - loop[k].position).dot(n);
    const double closing = speeds_[loop[k].edge] - way->dot(n);
    if (closing <= 1e-12 || distance_m < -kSameM) return;
    const double wait_m = std::max(0.0, distance_m / closing);
    if (wait_m >= next.wait_m - kSameM) return;
    const Vector2d at = loop[i].position + wait_m * *way;
    const Vector2d from = loop[k].position + wait_m * *first;
    const Vector2d to = after(loop, k).position + wait_m * *second;
    const Vector2d along(n.y(), -n.x());
    if ((at - from).dot(along) < -kSameM || (at - to).dot(along) > kSameM) return;
    next = {wait_m, number, i, k, true};
  }

  Next next_event() const {
    Next next;
    for (std::size_t number = 0; number < loops_.size(); ++number) {
      const Loop& loop = loops_[number];
      for (std::size_t i = 0; i < loop.size(); ++i) look_at_edge(loop, i, number, next);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (!is_reflex(loop, i)) continue;
        for (std::size_t k = 0; k < loop.size(); ++k) look_at_split(loop, i, k, number, next);
      }
    }
    return next;
  }

  void advance(double wait_m) {
    now_m_ += wait_m;
    for (Loop& loop : loops_) {
      std::vector<Vector2d> moved;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        moved.emplace_back(loop[i].position +
                           wait_m * velocity(loop, i).value_or(Vector2d::Zero()));
      }
      for (std::size_t i = 0; i < loop.size(); ++i) loop[i].position = moved[i];
    }
  }

  /// Ends the strip of an edge here and now.
  void end_strip(const Corner& corner, const Vector2d& to) {
    if (now_m_ - corner.strip_from_m < kSameM) return;
    strips_.push_back({corner.edge,
                       {corner.strip_from, corner.strip_to, to, corner.position},
                       corner.strip_from_m,
                       now_m_});
  }

  void restart_strip(Loop& loop, std::size_t i) {
    end_strip(loop[i], after(loop, i).position);
    loop[i].strip_from = loop[i].position;
    loop[i].strip_to = after(loop, i).position;
    loop[i].strip_from_m = now_m_;
  }

  void restart_strips(Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) restart_strip(loop, i);
  }

  /// Removes edges without length, and what encloses nothing.
  void clean(Loop& loop) {
    constexpr double kNothingM2 = 1e-6;
    std::vector<Vector2d> outline;
    for (const Corner& corner : loop) outline.push_back(corner.position);
    if (loop.size() < 3 || std::abs(signed_area(outline)) < kNothingM2) {
      for (std::size_t i = 0; i < loop.size(); ++i) end_strip(loop[i], after(loop, i).position);
      loop.clear();
      return;
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t last = (i + loop.size() - 1) % loop.size();
      if ((after(loop, i).position - loop[i].position).norm() < 10 * kSameM) {
        restart_around(loop, i);
      } else if (!velocity(loop, i)) {
        // A spike without width, down to the nearer of its ends.
        const Vector2d tip = loop[i].position;
        restart_around(loop, i);
        if ((loop[last].position - tip).norm() < (after(loop, i).position - tip).norm()) {
          loop[i].position = loop[last].position;
          loop[i].strip_from = loop[i].position;
          erase(loop, last);
          return clean(loop);
        }
        loop[last].strip_to = after(loop, i).position;
      } else {
        continue;
      }
      erase(loop, i);
      return clean(loop);
    }
  }

  static void erase(Loop& loop, std::size_t i) {
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
  }

  void restart_around(Loop& loop, std::size_t i) {
    restart_strip(loop, i);
    restart_strip(loop, (i + loop.size() - 1) % loop.size());
    restart_strip(loop, (i + 1) % loop.size());
  }

  /// A corner meets an edge: the outline falls into two.
  void split(const Next& next) {
    Loop loop = std::move(loops_[next.loop]);
    const std::size_t size = loop.size();
    restart_strip(loop, next.corner);
    restart_strip(loop, (next.corner + size - 1) % size);
    restart_strip(loop, next.edge);
    const Vector2d at = loop[next.corner].position;
    // One part has the edges from the corner to the one that was hit, whose first piece ends here.
    Loop left;
    for (std::size_t i = next.corner; i != next.edge; i = (i + 1) % size) left.push_back(loop[i]);
    left.push_back(loop[next.edge]);
    left.back().strip_to = at;
    Loop right = {loop[next.edge]};
    right.front().position = at;
    right.front().strip_from = at;
    for (std::size_t i = (next.edge + 1) % size; i != next.corner; i = (i + 1) % size) {
      right.push_back(loop[i]);
    }
    loops_[next.loop] = std::move(left);
    loops_.push_back(std::move(right));
  }

  std::vector<Vector2d> inward_;
  std::vector<double> speeds_;
  std::vector<Loop> loops_;
  std::vector<SweptStrip> strips_;
  double now_m_ = 0;
};

/// Whether the strips cover as much as the polygon encloses.
bool cover(const std::vector<SweptStrip>& strips, double area_m2) {
  constexpr double kSlack = 1e-3;
  double covered_m2 = 0;
  for (const SweptStrip& strip : strips) {
    const double strip_m2 = signed_area(strip.corners);
    if (strip_m2 < -kSlack * area_m2) return false;
    covered_m2 += strip_m2;
  }
  return std::abs(covered_m2 - area_m2) < kSlack * area_m2;
}

}  // namespace

std::vector<SweptStrip> sweep_inwards(std::span<const Vector2d> polygon,
                                      std::span<const EdgeSpeeds> speeds) {
  constexpr std::size_t kMaxCorners = 64;
  if (polygon.size() < 3 || polygon.size() > kMaxCorners) return {};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if ((polygon[(i + 1) % polygon.size()] - polygon[i]).norm() < 1e-3) return {};
  }
  Sweep sweep(polygon);
  if (!sweep.run(speeds)) return {};
  std::vector<SweptStrip> strips = sweep.take();
  if (!cover(strips, signed_area(polygon))) return {};
  return strips;
}

}  // namespace throng::geometry
