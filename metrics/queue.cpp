#include "metrics/queue.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "metrics/point_grid.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kLinkM = 1.2;
constexpr double kSlow = 0.5;  // of the desired speed

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
  // Shortest ways over the links (Dijkstra 1959), from everybody in the zone at once.
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
  std::vector<double> way(slow.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < slow.size(); ++i) {
    if (!zone.contains(slow[i])) continue;
    way[i] = (slow[i] - zone.middle()).norm();
    next.emplace(way[i], i);
  }
  if (next.empty()) return {};
  const PointGrid grid(slow, kLinkM);
  Queue queue;
  while (!next.empty()) {
    const auto [length, at] = next.top();
    next.pop();
    if (length > way[at]) continue;
    ++queue.people;
    queue.length_m = std::max(queue.length_m, length);
    grid.for_within(slow[at], kLinkM, [&, from = at, so_far = length](std::size_t other) {
      const double longer = so_far + (slow[other] - slow[from]).norm();
      if (longer >= way[other]) return;
      way[other] = longer;
      next.emplace(longer, other);
    });
  }
  return queue;
}

}  // namespace throng::metrics
