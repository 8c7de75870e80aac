#include "metrics/bounds/run_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "metrics/basis/percents.h"
#include "metrics/basis/survival.h"
#include "metrics/bounds/flow_bound.h"
#include "metrics/bounds/path_bound.h"
#include "metrics/exits/door_capacity.h"
#include "metrics/exits/exit_state.h"

namespace throng::metrics {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// When and where somebody sets out, by the run's clock.
struct SettingOut {
  double time_s = kNever;
  Vector2d point = Vector2d::Zero();
};

SettingOut setting_out(const PersonRecord& person, const world::Alarm& alarm, Knowledge knowledge) {
  const bool notices = knowledge == Knowledge::as_noticed && alarm.at_s;
  if (notices && person.noticed_s) return {*person.noticed_s, person.noticed_place};
  if (notices && !person.escaped_s) return {};
  return {person.start_s, person.start_place};
}

/// Somebody as the quickest flow sees them; all times by the run's clock.
struct Traveler {
  double start_s = 0;
  double end_s = 0;                ///< counts until then
  std::vector<double> access_s;    ///< per exit; infinite: never
  std::optional<double> beside_s;  ///< when they are out at best, through no door
};

/// The doors of Departures, by the run's clock.
struct Doors {
  std::vector<double> capacity_per_s, burst, on_s, closes_at_s;
};

// When a traveler could be out if the doors were theirs alone.
double alone_s(const Traveler& traveler, const Doors& doors) {
  double best_s = kNever;
  for (std::size_t e = 0; e < traveler.access_s.size(); ++e) {
    if (doors.capacity_per_s[e] <= 0 || traveler.access_s[e] > doors.closes_at_s[e]) continue;
    best_s = std::min(best_s, traveler.access_s[e] + doors.on_s[e]);
  }
  return best_s;
}

Departures group_departures(const std::vector<const Traveler*>& travelers, const Doors& doors,
                            double origin_s) {
  Departures departures;
  departures.capacity_per_s = doors.capacity_per_s;
  departures.burst = doors.burst;
  departures.on_s = doors.on_s;
  for (const double closes_at_s : doors.closes_at_s)
    departures.closes_at_s.push_back(closes_at_s - origin_s);
  for (const Traveler* traveler : travelers) {
    auto& row = departures.access_s.emplace_back(traveler->access_s);
    for (double& access_s : row) access_s = std::max(0.0, access_s - origin_s);
  }
  return departures;
}

// People present from the origin on share the doors; later ones have them for themselves, which
// makes their times no longer.
BestTimes best_times(const std::vector<Traveler>& travelers, const Doors& doors, double origin_s) {
  BestTimes best;
  std::vector<const Traveler*> sharing;
  double sum_s = 0;
  const auto add = [&](double escape_s, double watched_s) {
    best.escape_s.push_back(std::max(0.0, escape_s));
    sum_s += std::min(best.escape_s.back(), watched_s);
  };
  for (const Traveler& traveler : travelers) {
    const double watched_s = traveler.end_s - traveler.start_s;
    if (traveler.beside_s) {
      add(*traveler.beside_s - traveler.start_s, watched_s);
    } else if (traveler.start_s > origin_s + world::kTimeSlackS) {
      add(alone_s(traveler, doors) - traveler.start_s, watched_s);
    } else {
      sharing.push_back(&traveler);
    }
  }
  if (!sharing.empty()) {
    const double watched_s = sharing.front()->end_s - origin_s;
    for (const double out_s : earliest_out_s(group_departures(sharing, doors, origin_s))) {
      add(out_s, watched_s);
    }
  }
  std::sort(best.escape_s.begin(), best.escape_s.end());
  best.mean_s = sum_s / static_cast<double>(travelers.size());
  return best;
}

std::vector<const PersonRecord*> select_evacuees(const std::vector<PersonRecord>& people) {
  std::vector<const PersonRecord*> evacuees;
  for (const PersonRecord& person : people) {
    if (person.is_evacuee()) evacuees.push_back(&person);
  }
  return evacuees;
}

double max_speed_mps(const std::vector<const PersonRecord*>& people,
                     double PersonRecord::*speed_mps) {
  double max_mps = 0;
  for (const PersonRecord* person : people) max_mps = std::max(max_mps, person->*speed_mps);
  return max_mps;
}

// How long it takes at least from anywhere in a door to beyond the scenario.
double beyond_s(const world::Scenario& scenario, const world::Exit& exit, double speed_mps) {
  const double from_m = scenario.inside.distance_to_border(exit.from);
  return std::min(from_m, scenario.inside.distance_to_border(exit.to)) / speed_mps;
}

/// Whether a person got out by a door after having set out.
bool went_by_door(const PersonRecord& person, const SettingOut& out) {
  return person.last_out && person.last_out->time_s >= out.time_s - world::kTimeSlackS;
}

class LowerBound {
 public:
  LowerBound(const world::Scenario& scenario, std::vector<const PersonRecord*> people,
             const world::Alarm& alarm, const BoundSpec& spec)
      : scenario_(scenario),
        people_(std::move(people)),
        model_(spec.model),
        paths_(scenario, spec.max_radius_m),
        origin_s_(alarm.at_s.value_or(0)),
        max_mps_(throng::metrics::max_speed_mps(people_, &PersonRecord::max_speed_mps)) {
    for (const PersonRecord* person : people_) {
      starts_.push_back(setting_out(*person, alarm, spec.knowledge));
    }
  }

  BestTimes times(double end_s) {
    make_doors();
    std::vector<Traveler> travelers;
    for (std::size_t i = 0; i < people_.size(); ++i) travelers.push_back(traveler(i, end_s));
    raise_bursts(travelers);
    BestTimes best = best_times(travelers, doors_, origin_s_);
    best.raised_doors = raised_doors_;
    return best;
  }

 private:
  /// That of the model, or the imposed one if it is less.
  DoorCapacity capacity_of(const world::Exit& exit) const {
    DoorCapacity capacity = door_capacity(model_, exit.width_m());
    if (!exit.capacity) return capacity;
    constexpr double kImposedBurst = 2;  // admitted people may pass together
    const double imposed = exit.capacity->per_s_at(exit.width_m());
    if (imposed < capacity.rate_per_s) capacity = {kImposedBurst, imposed};
    return capacity;
  }

  void make_doors() {
    for (const world::Exit& exit : scenario_.exits) {
      const DoorCapacity capacity = capacity_of(exit);
      doors_.capacity_per_s.push_back(exit.open ? capacity.rate_per_s : 0);
      doors_.burst.push_back(capacity.burst);
      doors_.on_s.push_back(max_mps_ > 0 ? beyond_s(scenario_, exit, max_mps_) : kNever);
      doors_.closes_at_s.push_back(exit.closes_at_s);
    }
    for (std::size_t i = 0; i < people_.size(); ++i) {
      if (!people_[i]->escaped_s || !went_by_door(*people_[i], starts_[i])) continue;
      const DoorPassage& passage = *people_[i]->last_out;
      const std::size_t e = passage.exit;
      doors_.on_s[e] = std::min(doors_.on_s[e], *people_[i]->escaped_s - passage.time_s);
      // People who know of nothing pass doors that are closed to the others.
      if (doors_.capacity_per_s[e] <= 0) {
        doors_.capacity_per_s[e] = capacity_of(scenario_.exits[e]).rate_per_s;
        doors_.closes_at_s[e] = 0;
      }
      doors_.closes_at_s[e] =
          std::max(doors_.closes_at_s[e], passage.time_s + 2 * world::kTimeSlackS);
    }
  }

  Traveler traveler(std::size_t i, double end_s) const {
    const PersonRecord& person = *people_[i];
    const SettingOut& out = starts_[i];
    Traveler traveler{person.start_s, end_s, std::vector<double>(doors_.on_s.size(), kNever), {}};
    if (!std::isfinite(out.time_s)) return traveler;
    const double speed_mps = person.max_speed_mps;
    if (person.escaped_s && !went_by_door(person, out)) {
      const double side_m = scenario_.inside.distance_to_border(out.point);
      const double beside_s = speed_mps > 0 ? out.time_s + side_m / speed_mps : kNever;
      traveler.beside_s = std::min(beside_s, *person.escaped_s);
      return traveler;
    }
    for (std::size_t e = 0; e < doors_.on_s.size() && speed_mps > 0; ++e) {
      traveler.access_s[e] = out.time_s + paths_.to_door_m(e, out.point) / speed_mps;
    }
    if (person.escaped_s) {
      double& used_s = traveler.access_s[person.last_out->exit];
      used_s = std::min(used_s, person.last_out->time_s);
    }
    return traveler;
  }

  // If more people passed a door in any slots in a row than its capacity allows, it can pass that
  // many.
  void raise_bursts(const std::vector<Traveler>& travelers) {
    for (std::size_t e = 0; e < doors_.on_s.size(); ++e) {
      std::vector<double> passages_s;
      for (std::size_t i = 0; i < people_.size(); ++i) {
        const bool shares = travelers[i].start_s <= origin_s_ + world::kTimeSlackS;
        if (!shares || travelers[i].beside_s) continue;
        const auto& last_out = people_[i]->last_out;
        if (people_[i]->escaped_s && last_out->exit == e) passages_s.push_back(last_out->time_s);
      }
      std::sort(passages_s.begin(), passages_s.end());
      // People before a slot, less the rate up to it: the burst is the most by which it rises.
      double needed = 0;
      double least = kNever;
      for (std::size_t k = 0; k < passages_s.size(); ++k) {
        const double slot = std::floor(passages_s[k] - origin_s_);
        const auto before = static_cast<double>(k);
        least = std::min(least, before - doors_.capacity_per_s[e] * slot);
        needed = std::max(needed, before + 1 - doors_.capacity_per_s[e] * (slot + 1) - least);
      }
      if (needed <= doors_.burst[e]) continue;
      doors_.burst[e] = needed;
      ++raised_doors_;
    }
  }

  const world::Scenario& scenario_;
  std::vector<const PersonRecord*> people_;
  std::string model_;
  PathBound paths_;
  double origin_s_;
  double max_mps_;
  std::vector<SettingOut> starts_;  ///< per person
  Doors doors_;
  int raised_doors_ = 0;
};

using Distance = std::function<double(std::size_t exit, const Vector2d& point)>;
using Speed = std::function<double(const PersonRecord&)>;

std::optional<BestTimes> reference_times(const world::Scenario& scenario,
                                         const std::vector<PersonRecord>& people,
                                         const world::Alarm& alarm, double end_s,
                                         Knowledge knowledge,
                                         const std::vector<double>& capacity_per_s,
                                         const Distance& distance_m, const Speed& speed_mps) {
  const std::vector<const PersonRecord*> evacuees = select_evacuees(people);
  if (evacuees.empty() || scenario.exits.empty()) return std::nullopt;
  double max_mps = 0;
  for (const PersonRecord* person : evacuees) max_mps = std::max(max_mps, speed_mps(*person));
  if (max_mps <= 0) return std::nullopt;
  Doors doors;
  for (std::size_t e = 0; e < scenario.exits.size(); ++e) {
    const world::Exit& exit = scenario.exits[e];
    doors.capacity_per_s.push_back(exit.open ? capacity_per_s[e] : 0);
    doors.on_s.push_back(scenario.inside.distance_to_border(exit.middle()) / max_mps);
    doors.closes_at_s.push_back(exit.closes_at_s);
  }
  std::vector<Traveler> travelers;
  for (const PersonRecord* person : evacuees) {
    Traveler& traveler = travelers.emplace_back();
    traveler = {person->start_s, end_s, std::vector<double>(doors.on_s.size(), kNever), {}};
    const SettingOut out = setting_out(*person, alarm, knowledge);
    const double mps = speed_mps(*person);
    for (std::size_t e = 0; e < doors.on_s.size() && mps > 0; ++e) {
      traveler.access_s[e] = out.time_s + distance_m(e, out.point) / mps;
    }
  }
  return best_times(travelers, doors, alarm.at_s.value_or(0));
}

json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

}  // namespace

std::optional<double> BestTimes::percentile_s(int percent) const {
  return time_by_which(escape_s, static_cast<int>(escape_s.size()), percent);
}

std::optional<BestTimes> lower_bound(const world::Scenario& scenario,
                                     const std::vector<PersonRecord>& people,
                                     const world::Alarm& alarm, double end_s,
                                     const BoundSpec& spec) {
  std::vector<const PersonRecord*> evacuees = select_evacuees(people);
  if (evacuees.empty()) return std::nullopt;
  return LowerBound(scenario, std::move(evacuees), alarm, spec).times(end_s);
}

std::optional<BestTimes> reference_time(const world::Scenario& scenario,
                                        const std::vector<PersonRecord>& people,
                                        const world::Alarm& alarm, double end_s,
                                        Knowledge knowledge,
                                        const std::vector<WalkingDistance>& distances) {
  std::vector<double> capacities;
  for (const world::Exit& exit : scenario.exits) {
    capacities.push_back(capacity_per_s(exit));
  }
  return reference_times(
      scenario, people, alarm, end_s, knowledge, capacities,
      [&](std::size_t exit, const Vector2d& point) {
        // Somebody whom rounding has put into a wall stands somewhere all the same.
        return distances[exit].from(point).value_or((point - scenario.exits[exit].middle()).norm());
      },
      [](const PersonRecord& person) { return person.max_desired_mps; });
}

std::optional<BestTimes> reference_time(const world::Scenario& scenario,
                                        const std::vector<PersonRecord>& people,
                                        const world::Alarm& alarm, double end_s,
                                        Knowledge knowledge, const ReferenceSpec& spec) {
  return reference_times(
      scenario, people, alarm, end_s, knowledge, spec.capacity_per_s,
      [&](std::size_t exit, const Vector2d& point) {
        return (point - scenario.exits[exit].middle()).norm();
      },
      [&](const PersonRecord&) { return spec.speed_mps; });
}

std::optional<double> ratio_to(const BestTimes& best, const EscapeTimes& times, int percent) {
  const auto best_s = best.percentile_s(percent);
  const auto time_s = times.percentile_s(percent);
  if (!best_s || !time_s || !std::isfinite(*best_s) || *best_s <= 0) return std::nullopt;
  return *time_s / *best_s;
}

json to_json(const std::optional<BestTimes>& best, const EscapeTimes& times) {
  if (!best) return nullptr;
  json result = {{"mean_s", best->mean_s}, {"mean_ratio", nullptr}};
  if (best->mean_s > 0) result["mean_ratio"] = times.mean_censored_s() / best->mean_s;
  for (const int percent : kPercents) {
    result[fmt::format("t{}_s", percent)] = number_or_null(best->percentile_s(percent));
    result[fmt::format("t{}_ratio", percent)] = number_or_null(ratio_to(*best, times, percent));
  }
  return result;
}

}  // namespace throng::metrics
