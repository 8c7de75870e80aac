#include "metrics/flow_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

// From the door's middle to beyond the nearest side of the rectangle; 0 outside.
double way_out_m(const world::Rectangle& inside, const Vector2d& door) {
  const Vector2d to_min = door - inside.min;
  const Vector2d to_max = inside.max - door;
  return std::max(0.0, std::min(to_min.minCoeff(), to_max.minCoeff()));
}

// One second of one exit and how many it lets out in it.
struct Slot {
  std::size_t exit;
  int second;    // in which people must be at the door
  double out_s;  // when they are out at last
  int room;
};

// Maximum flow of people through slots by augmenting paths (Ford and Fulkerson 1956): a person fits
// every slot of an exit not earlier than it can be there. Slots come one by one, the earliest
// first, and what was matched stays matched, so the flow is maximal after each.
class Matching {
 public:
  Matching(std::vector<std::vector<double>> access_s) : access_s_(std::move(access_s)) {
    slot_of_.assign(access_s_.size(), -1);
  }

  /// How many more people are out with this slot.
  int add(const Slot& slot) {
    slots_.push_back(slot);
    users_.emplace_back();
    int more = 0;
    while (more < slot.room) {
      visited_.assign(slots_.size(), false);
      if (!fill(slots_.size() - 1)) break;
      ++more;
    }
    return more;
  }

 private:
  bool fits(std::size_t person, const Slot& slot) const {
    return access_s_[person][slot.exit] <= slot.second + 1;
  }

  // Finds one more person for the slot: one who waits, or one of another slot that finds another.
  bool fill(std::size_t slot) {
    visited_[slot] = true;
    for (std::size_t person = 0; person < slot_of_.size(); ++person) {
      if (slot_of_[person] < 0 && fits(person, slots_[slot])) {
        take(person, slot);
        return true;
      }
    }
    for (std::size_t other = 0; other < slots_.size(); ++other) {
      if (visited_[other]) continue;
      for (const std::size_t person : users_[other]) {
        if (!fits(person, slots_[slot])) continue;
        if (!fill(other)) break;  // nobody else for that one, whoever leaves it
        auto& users = users_[other];
        users.erase(std::find(users.begin(), users.end(), person));
        take(person, slot);
        return true;
      }
    }
    return false;
  }

  void take(std::size_t person, std::size_t slot) {
    slot_of_[person] = static_cast<int>(slot);
    users_[slot].push_back(person);
  }

  std::vector<std::vector<double>> access_s_;  // per person and exit
  std::vector<Slot> slots_;
  std::vector<std::vector<std::size_t>> users_;  // per slot
  std::vector<int> slot_of_;                     // per person; -1: none
  std::vector<bool> visited_;
};

std::vector<Slot> slots_by_time(const world::Scenario& place, const BoundSpec& spec, int seconds) {
  std::vector<Slot> slots;
  for (std::size_t e = 0; e < place.exits.size(); ++e) {
    if (!place.exits[e].open) continue;
    const double on_s = way_out_m(place.inside, place.exits[e].middle()) / spec.speed_mps;
    for (int second = 0; second < seconds; ++second) {
      // Rounded so that no people get lost over the seconds.
      const double rate = spec.capacity_per_s[e];
      const int room = static_cast<int>(std::ceil(rate * (second + 1)) - std::ceil(rate * second));
      slots.push_back({e, second, second + on_s, room});
    }
  }
  std::stable_sort(slots.begin(), slots.end(),
                   [](const Slot& a, const Slot& b) { return a.out_s < b.out_s; });
  return slots;
}

}  // namespace

FlowBound flow_bound(const world::Scenario& place, const std::vector<Vector2d>& people,
                     const BoundSpec& spec) {
  if (people.empty()) return {};
  std::vector<std::vector<double>> access_s;
  double farthest_s = 0;
  double capacity = 0;
  for (const Vector2d& person : people) {
    auto& row = access_s.emplace_back();
    for (const world::Exit& exit : place.exits) {
      row.push_back((person - exit.middle()).norm() / spec.speed_mps);
      farthest_s = std::max(farthest_s, row.back());
    }
  }
  for (std::size_t e = 0; e < place.exits.size(); ++e) {
    if (place.exits[e].open) capacity += spec.capacity_per_s[e];
  }
  const double infinity = std::numeric_limits<double>::infinity();
  if (capacity <= 0) return {infinity, infinity, infinity, infinity};

  const auto count = static_cast<double>(people.size());
  const int seconds = static_cast<int>(std::ceil(farthest_s + count / capacity)) + 60;
  Matching matching(std::move(access_s));
  FlowBound bound{infinity, infinity, infinity, 0};
  double out = 0;
  for (const Slot& slot : slots_by_time(place, spec, seconds)) {
    if (out == count) break;
    const double more = matching.add(slot);
    out += more;
    bound.mean_s += more * slot.out_s / count;
    if (out >= 0.5 * count) bound.t50_s = std::min(bound.t50_s, slot.out_s);
    if (out >= 0.9 * count) bound.t90_s = std::min(bound.t90_s, slot.out_s);
    if (out == count) bound.t100_s = slot.out_s;
  }
  if (out < count) bound.mean_s = infinity;
  return bound;
}

}  // namespace throng::metrics
