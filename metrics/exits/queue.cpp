#include "metrics/exits/queue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/geometry/point_grid.h"
#include "metrics/exits/exit_state.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kLinkM = 1.2;
constexpr double kSlow = 0.5;      // of the desired speed
constexpr double kMinLaneM = 0.8;  // one person walks through; narrower doors pass as many
constexpr double kAboveRounding = 1 + 1e-9;

/// Shortest paths over the links from everybody in the zone at once. Paths that end within 0.25 m
/// are taken in any order, and again when they get shorter (Dial 1969; Meyer and Sanders 2003):
/// what comes out is what Dijkstra's order gives, for less than its heap costs.
class PathsBack {
 public:
  PathsBack(std::size_t people) : path_m_(people, kUnknown), taken_m_(people, kUnknown) {}

  double of(std::size_t person) const { return path_m_[person]; }

  void offer(std::size_t person, double path_m) {
    if (path_m >= path_m_[person]) return;
    path_m_[person] = path_m;
    const auto bin = static_cast<std::size_t>(path_m / kBinM);
    if (bin >= bins_.size()) bins_.resize(bin + 1);
    bins_[bin].push_back(person);
  }

  /// Whose links are to be followed next.
  std::optional<std::size_t> next() {
    for (; bin_ < bins_.size(); ++bin_) {
      while (!bins_[bin_].empty()) {
        const std::size_t person = bins_[bin_].back();
        bins_[bin_].pop_back();
        if (taken_m_[person] == path_m_[person]) continue;
        taken_m_[person] = path_m_[person];
        return person;
      }
    }
    return std::nullopt;
  }

  /// People whom the links reach, and the longest of their paths.
  Queue queue() const {
    Queue queue;
    for (const double path_m : path_m_) {
      if (path_m == kUnknown) continue;
      ++queue.people;
      queue.length_m = std::max(queue.length_m, path_m);
    }
    return queue;
  }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  static constexpr double kBinM = 0.25;

  std::vector<double> path_m_;   ///< per person
  std::vector<double> taken_m_;  ///< the path when the links were followed last
  std::vector<std::vector<std::size_t>> bins_;
  std::size_t bin_ = 0;  ///< all before it are empty
};

}  // namespace

Queue queue_before(const ControlZone& zone, const Vector2d& outward,
                   std::span<const NearPerson> people) {
  std::vector<Vector2d> slow;
  for (const NearPerson& person : people) {
    if (person.comes_here && (person.place - zone.middle()).dot(outward) < 0 &&
        person.velocity.norm() < kSlow * person.desired_speed_mps) {
      slow.push_back(person.place);
    }
  }
  if (slow.empty()) return {};
  const geometry::PointGrid grid(slow, kLinkM);
  PathsBack paths(grid.size());
  const Vector2d along(-outward.y(), outward.x());
  double min_m = std::numeric_limits<double>::max(), max_m = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Vector2d& place = grid.stored(i);
    if (!zone.contains(place)) continue;
    paths.offer(i, (place - zone.middle()).norm());
    min_m = std::min(min_m, (place - zone.middle()).dot(along));
    max_m = std::max(max_m, (place - zone.middle()).dot(along));
  }
  while (const auto next = paths.next()) {
    const Vector2d& from = grid.stored(*next);
    const double so_far = paths.of(*next);
    grid.for_stored_about(from, kLinkM, [&](std::size_t other, const Vector2d& there) {
      const double left_m = paths.of(other) - so_far;
      if (left_m <= 0) return;
      const double squared = (there - from).squaredNorm();
      // Most are not worth a root.
      if (squared > kLinkM * kLinkM || squared > kAboveRounding * left_m * left_m) return;
      paths.offer(other, so_far + std::sqrt(squared));
    });
  }
  Queue queue = paths.queue();
  if (queue.people > 0) queue.breadth_m = max_m - min_m;
  return queue;
}

WaitPredictor::WaitPredictor(const world::Exit& exit, double mean_radius_m, double dt_s)
    : width_m_(exit.width_m()),
      per_ms_(capacity_per_s(exit) / exit.width_m()),
      mean_radius_m_(mean_radius_m),
      dt_s_(dt_s),
      window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kWindowS / dt_s)))) {}

double WaitPredictor::step(const Queue& queue, int crossed_out) {
  // A person who crosses in a step was in the queue at the step before.
  const Step now{had_queue_, crossed_out - crossed_out_};
  crossed_out_ = crossed_out;
  had_queue_ = queue.people > 0;
  last_.push_back(now);
  if (now.queued) {
    ++queued_steps_;
    served_ += now.out;
  }
  if (last_.size() > window_) {
    if (last_.front().queued) {
      --queued_steps_;
      served_ -= last_.front().out;
    }
    last_.pop_front();
  }
  const double queued_s = static_cast<double>(queued_steps_) * dt_s_;
  const double used_m =
      std::max(kMinLaneM, std::min(width_m_, queue.breadth_m + 2 * mean_radius_m_));
  const double rate = (served_ + per_ms_ * used_m * kPriorS) / (queued_s + kPriorS);
  return queue.people / rate;
}

}  // namespace throng::metrics
