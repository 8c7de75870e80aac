#include "metrics/people/escape_times.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace throng::metrics {

using nlohmann::json;

std::vector<Watched> EscapeTimes::watched() const {
  std::vector<Watched> unhurt;
  for (const double time_s : escape_s) unhurt.push_back({time_s, true});
  for (const double time_s : inside_s) unhurt.push_back({time_s, false});
  return unhurt;
}

std::optional<double> EscapeTimes::percentile_s(int percent) const {
  return time_by_which(escape_s, evacuees(), percent);
}

double EscapeTimes::mean_censored_s() const {
  if (evacuees() == 0) return 0;
  double sum_s = std::accumulate(escape_s.begin(), escape_s.end(), 0.0) +
                 std::accumulate(inside_s.begin(), inside_s.end(), 0.0);
  for (const Casualty& casualty : casualties) sum_s += casualty.watched_s;
  return sum_s / evacuees();
}

std::optional<double> EscapeTimes::restricted_mean_s(double until_s) const {
  const std::vector<Watched> unhurt = watched();
  if (evacuees() == 0) return std::nullopt;
  if (unhurt.empty()) return until_s;
  const auto mean_s = throng::metrics::restricted_mean_s(unhurt, until_s);
  if (!mean_s) return std::nullopt;
  return (static_cast<double>(unhurt.size()) * *mean_s +
          static_cast<double>(casualties.size()) * until_s) /
         evacuees();
}

int EscapeTimes::inside_after(double after_s) const {
  const auto escaped_later = escape_s.end() - std::upper_bound(escape_s.begin(), escape_s.end(),
                                                               after_s + world::kTimeSlackS);
  const auto watched_for = inside_s.end() - std::lower_bound(inside_s.begin(), inside_s.end(),
                                                             after_s - world::kTimeSlackS);
  const auto hurt_later = std::count_if(
      casualties.begin(), casualties.end(),
      [&](const Casualty& casualty) { return casualty.hurt_s > after_s + world::kTimeSlackS; });
  return static_cast<int>(escaped_later + watched_for + hurt_later);
}

std::vector<double> EscapeTimes::curve() const {
  std::vector<double> curve;
  double last_s =
      std::max(escape_s.empty() ? 0.0 : escape_s.back(), inside_s.empty() ? 0.0 : inside_s.back());
  for (const Casualty& casualty : casualties) last_s = std::max(last_s, casualty.watched_s);
  const double unhurt_share = evacuees() == 0 ? 0
                                              : 1 - static_cast<double>(casualties.size()) /
                                                        static_cast<double>(evacuees());
  const std::vector<Survival> steps = estimate_survival(watched());
  auto next = steps.begin();
  double left = 1;
  const auto seconds = static_cast<long>(std::ceil(last_s - world::kTimeSlackS));
  for (long second = 0; second <= seconds; ++second) {
    while (next != steps.end() &&
           next->time_s <= static_cast<double>(second) + world::kTimeSlackS) {
      left = (next++)->share;
    }
    curve.push_back(unhurt_share * (1 - left));
  }
  return curve;
}

EscapeTimes escape_times(const std::vector<PersonRecord>& people, double end_s) {
  EscapeTimes times;
  for (const PersonRecord& person : people) {
    ++times.people;
    if (!person.was_inside) {
      ++(person.came_to_exit ? times.turned_back : times.never_inside);
    } else if (person.left_before_alarm()) {
      ++times.left_before_alarm;
    } else if (person.escaped_s) {
      times.escape_s.push_back(std::max(0.0, *person.escaped_s - person.start_s));
    } else if (person.hurt_s) {
      times.casualties.push_back(
          {std::max(0.0, end_s - person.start_s), std::max(0.0, *person.hurt_s - person.start_s)});
    } else {
      if (person.vanished_s) ++times.vanished;
      times.inside_s.push_back(std::max(0.0, person.vanished_s.value_or(end_s) - person.start_s));
    }
  }
  std::sort(times.escape_s.begin(), times.escape_s.end());
  std::sort(times.inside_s.begin(), times.inside_s.end());
  std::sort(times.casualties.begin(), times.casualties.end(),
            [](const EscapeTimes::Casualty& one, const EscapeTimes::Casualty& other) {
              return std::pair(one.hurt_s, one.watched_s) <
                     std::pair(other.hurt_s, other.watched_s);
            });
  return times;
}

json to_json(const EscapeTimes& times) {
  json casualties = json::array();
  for (const EscapeTimes::Casualty& casualty : times.casualties) {
    casualties.push_back({{"watched_s", casualty.watched_s}, {"hurt_s", casualty.hurt_s}});
  }
  return {{"people", times.people},           {"left_before_alarm", times.left_before_alarm},
          {"turned_back", times.turned_back}, {"never_inside", times.never_inside},
          {"vanished", times.vanished},       {"escape_s", times.escape_s},
          {"inside_s", times.inside_s},       {"casualties", std::move(casualties)}};
}

EscapeTimes escape_times_from(const json& value) {
  EscapeTimes times;
  value.at("people").get_to(times.people);
  value.at("left_before_alarm").get_to(times.left_before_alarm);
  value.at("turned_back").get_to(times.turned_back);
  value.at("never_inside").get_to(times.never_inside);
  value.at("vanished").get_to(times.vanished);
  value.at("escape_s").get_to(times.escape_s);
  value.at("inside_s").get_to(times.inside_s);
  for (const json& casualty : value.at("casualties")) {
    times.casualties.push_back(
        {casualty.at("watched_s").get<double>(), casualty.at("hurt_s").get<double>()});
  }
  return times;
}

}  // namespace throng::metrics
