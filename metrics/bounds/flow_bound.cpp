#include "metrics/bounds/flow_bound.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Whether a door is closed from a second's beginning on.
bool is_closed(const Departures& departures, std::size_t exit, int second) {
  return !departures.closes_at_s.empty() && second >= departures.closes_at_s[exit];
}

/// People who can still pass a door. With a burst: a token bucket in whole people. From the slot of
/// the first arrival on, the slots bring floor(burst + rate * slots) in all, and of those that are
/// not used up to ceil(burst) stay for the next slot. No sequence of passages is refused that has
/// no more than burst + rate * t people in every t slots in a row: the t slots bring more than
/// rate * t - 1, which together with ceil(burst) is at least the integer part of that. Without one:
/// the rate, rounded so that no people get lost over the seconds, and nothing stays.
class DoorBucket {
 public:
  DoorBucket(const Departures& departures, std::size_t exit, int first_entry)
      : rate_per_s_(departures.capacity_per_s[exit]), first_entry_(first_entry) {
    if (!departures.burst.empty()) burst_ = departures.burst[exit];
  }

  /// Opens the slot that begins with a second; slots open in order.
  void open(int second) {
    if (!burst_) {
      room_ =
          static_cast<int>(std::ceil(rate_per_s_ * (second + 1)) - std::ceil(rate_per_s_ * second));
      return;
    }
    const int slots = second - first_entry_;
    const int kept = std::min(room_, static_cast<int>(std::ceil(*burst_)));
    room_ = kept + brought_after(slots + 1) - brought_after(slots);
  }

  int room() const { return room_; }
  void take(int people) { room_ -= people; }

 private:
  int brought_after(int slots) const {
    constexpr double kRounding = 1e-9;
    return slots <= 0 ? 0 : static_cast<int>(*burst_ + rate_per_s_ * slots + kRounding);
  }

  double rate_per_s_;
  std::optional<double> burst_;
  int first_entry_;
  int room_ = 0;
};

/// Maximum flow from people through doors that opens one slot after another. The network: each
/// person comes to each door in the second in which they can be there, and may wait from each
/// second of a door to its next. A person who has a slot keeps one, though not always the same.
class DoorFlow {
 public:
  DoorFlow(const Departures& departures)
      : doors_(departures.capacity_per_s.size()), exit_of_(departures.access_s.size(), kNone) {
    for (std::size_t person = 0; person < departures.access_s.size(); ++person) {
      auto& entry = entry_.emplace_back(doors_.size(), kNone);
      bool reaches = false;
      for (std::size_t e = 0; e < doors_.size(); ++e) {
        const double access_s = departures.access_s[person][e];
        if (departures.capacity_per_s[e] <= 0 || !std::isfinite(access_s)) continue;
        const int second = std::max(0, static_cast<int>(std::ceil(access_s - 1)));
        if (is_closed(departures, e, second)) continue;
        entry[e] = second;
        last_entry_ = std::max(last_entry_, second);
        doors_[e].people.push_back(person);
        reaches = true;
      }
      if (reaches) ++left_;
    }
    for (std::size_t e = 0; e < doors_.size(); ++e) {
      std::sort(doors_[e].people.begin(), doors_[e].people.end(),
                [&](std::size_t one, std::size_t other) {
                  return std::pair(entry_[one][e], one) < std::pair(entry_[other][e], other);
                });
    }
    target_.resize(exit_of_.size());
    seen_.assign(exit_of_.size(), 0);
  }

  /// How many of those who can get out at all have no slot yet.
  std::size_t left() const { return left_; }
  /// The last second in which anybody comes to any door.
  int last_entry() const { return last_entry_; }

  /// The first second in which anybody can be at the door; 0 if nobody ever is.
  int first_entry(std::size_t exit) const {
    const Door& door = doors_[exit];
    return door.people.empty() ? 0 : entry_[door.people.front()][exit];
  }

  /// Opens a slot of the door for `room` more people; returns how many more are out.
  int open(std::size_t exit, int second, int room) {
    Door& door = doors_[exit];
    door.waiting.resize(static_cast<std::size_t>(second) + 1, 0);
    door.on.resize(door.waiting.size());
    int more = 0;
    while (more < room && left_ > 0 && (send(exit, second) || reroute({exit, second}))) {
      ++more;
      --left_;
    }
    return more;
  }

 private:
  static constexpr int kNone = -1;

  /// A second of a door.
  struct DoorSecond {
    std::size_t exit = 0;
    int second = 0;
  };

  /// Next edge of a free path from a node to the new slot.
  struct On {
    enum class Kind { arrived, waits, waits_less, person };
    int search = 0;  ///< in which it was found
    Kind kind = Kind::arrived;
    std::size_t person = 0;  ///< who gives up the place for another
  };

  struct Door {
    std::vector<std::size_t> people;  ///< who can come here, by when
    std::size_t first_free = 0;       ///< all before it have slots
    std::vector<int> waiting;         ///< per second, people who wait until the next one
    std::vector<On> on;               ///< per second
  };

  // Takes the first one who waits for any slot and can be there.
  bool send(std::size_t exit, int second) {
    Door& door = doors_[exit];
    while (door.first_free < door.people.size() &&
           exit_of_[door.people[door.first_free]] != kNone) {
      ++door.first_free;
    }
    if (door.first_free == door.people.size()) return false;
    const std::size_t person = door.people[door.first_free];
    if (entry_[person][exit] > second) return false;
    exit_of_[person] = static_cast<int>(exit);
    for (int s = entry_[person][exit]; s < second; ++s) ++door.waiting[static_cast<std::size_t>(s)];
    return true;
  }

  // Breadth first, backward from the slot, over what the flow leaves free, to anybody without one.
  bool reroute(const DoorSecond& slot) {
    ++search_;
    next_.clear();
    reach(slot, On::Kind::arrived);
    while (!next_.empty()) {
      const DoorSecond place = next_.front();
      next_.pop_front();
      const std::vector<int>& waiting = doors_[place.exit].waiting;
      if (place.second > 0) reach({place.exit, place.second - 1}, On::Kind::waits);
      if (waiting[static_cast<std::size_t>(place.second)] > 0) {
        reach({place.exit, place.second + 1}, On::Kind::waits_less);
      }
      if (take_from(place)) return true;
    }
    return false;
  }

  void reach(const DoorSecond& place, On::Kind kind, std::size_t person = 0) {
    On& on = doors_[place.exit].on[static_cast<std::size_t>(place.second)];
    if (on.search == search_) return;
    on = {search_, kind, person};
    next_.push_back(place);
  }

  // The person who comes to the node and continues elsewhere: the end of the search if there is
  // none.
  bool take_from(const DoorSecond& place) {
    const auto e = static_cast<std::ptrdiff_t>(place.exit);
    const std::vector<std::size_t>& people = doors_[place.exit].people;
    const auto by_entry = [&](std::size_t person) { return entry_[person][place.exit]; };
    auto at = std::partition_point(people.begin(), people.end(), [&](std::size_t person) {
      return by_entry(person) < place.second;
    });
    for (; at != people.end() && by_entry(*at) == place.second; ++at) {
      if (exit_of_[*at] == e || seen_[*at] == search_) continue;
      seen_[*at] = search_;
      target_[*at] = place;
      if (exit_of_[*at] == kNone) {
        follow(*at);
        return true;
      }
      const auto other = static_cast<std::size_t>(exit_of_[*at]);
      reach({other, entry_[*at][other]}, On::Kind::person, *at);
    }
    return false;
  }

  // Moves the flow along the augmenting path.
  void follow(std::size_t person) {
    for (;;) {
      DoorSecond place = target_[person];
      Door& door = doors_[place.exit];
      exit_of_[person] = static_cast<int>(place.exit);
      const On* on = &door.on[static_cast<std::size_t>(place.second)];
      for (; on->kind == On::Kind::waits || on->kind == On::Kind::waits_less;
           on = &door.on[static_cast<std::size_t>(place.second)]) {
        if (on->kind == On::Kind::waits) {
          ++door.waiting[static_cast<std::size_t>(place.second++)];
        } else {
          --door.waiting[static_cast<std::size_t>(--place.second)];
        }
      }
      if (on->kind == On::Kind::arrived) return;
      person = on->person;
    }
  }

  std::vector<Door> doors_;
  std::vector<std::vector<int>> entry_;  ///< per person and exit, the second; kNone: never
  std::vector<int> exit_of_;             ///< per person; kNone: no slot
  std::vector<DoorSecond> target_;       ///< per person, where the search would have them go
  std::vector<int> seen_;                ///< per person, the last search that did
  std::deque<DoorSecond> next_;
  int search_ = 0;
  int last_entry_ = 0;
  std::size_t left_ = 0;
};

}  // namespace

std::vector<double> earliest_out_s(const Departures& departures) {
  const std::size_t exits = departures.capacity_per_s.size();
  check(departures.on_s.size() == exits, "every exit has a way out");
  DoorFlow flow(departures);
  std::vector<int> second(exits, 0);
  std::vector<DoorBucket> buckets;
  for (std::size_t e = 0; e < exits; ++e) buckets.emplace_back(departures, e, flow.first_entry(e));
  // Doors that serve nobody any more: who has no slot cannot get there, and others closed too soon.
  std::vector<bool> is_spent(exits, false);
  std::vector<double> out_s;
  while (flow.left() > 0) {
    std::size_t next = exits;
    for (std::size_t e = 0; e < exits; ++e) {
      if (departures.capacity_per_s[e] <= 0 || is_spent[e]) continue;
      if (is_closed(departures, e, second[e])) continue;
      const auto out_at_s = [&](std::size_t exit) { return second[exit] + departures.on_s[exit]; };
      if (next == exits || out_at_s(e) < out_at_s(next)) next = e;
    }
    if (next == exits) break;
    const int now = second[next]++;
    DoorBucket& bucket = buckets[next];
    bucket.open(now);
    const int room = bucket.room();
    const int more = flow.open(next, now, room);
    bucket.take(more);
    is_spent[next] = room > 0 && more == 0 && now >= flow.last_entry();
    out_s.insert(out_s.end(), static_cast<std::size_t>(more), now + departures.on_s[next]);
  }
  out_s.resize(departures.access_s.size(), kNever);
  return out_s;
}

}  // namespace throng::metrics
