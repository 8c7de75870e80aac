// How long people took to escape, each from the later of the alarm and their arrival. Metrics of a
// trace and studies have all their figures from here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/survival.h"

namespace throng::metrics {

struct EscapeTimes {
  int people = 0;             ///< everybody who took part at any time
  int left_before_alarm = 0;  ///< who had left before there was anything to escape from
  int never_inside = 0;       ///< who took no part in the evacuation (PersonRecord::was_inside)
  int vanished = 0;           ///< how many of `inside_s` were watched until they vanished only
  /// In order: of those who escaped from the later of alarm and arrival on (s).
  std::vector<double> escape_s;
  /// In order: of those who were inside when last seen, unhurt, for how long they had been watched
  /// (s).
  std::vector<double> inside_s;
  /// Somebody who lay hurt inside at the end.
  struct Casualty {
    double watched_s = 0;
    double hurt_s = 0;  ///< from when on they lay, by the same clock
  };
  std::vector<Casualty> casualties;  ///< in order of `hurt_s`

  /// Those whose escape is measured: people who were inside, and did not leave before the alarm.
  int evacuees() const {
    return static_cast<int>(escape_s.size() + inside_s.size() + casualties.size());
  }
  /// Inside at the end, unhurt.
  int not_escaped() const { return static_cast<int>(inside_s.size()) - vanished; }
  /// The ceil(percent * evacuees / 100)-th escape time; empty if fewer escaped.
  std::optional<double> percentile_s(int percent) const;
  /// Mean escape time; who did not escape counts with the time watched. 0 without anybody.
  double mean_censored_s() const;
  /// Restricted mean survival time: the area below the share still inside, up to `until_s` (Royston
  /// and Parmar, BMC Med. Res. Methodol. 13, 2013). The share is the product-limit estimate of the
  /// unhurt; casualties stay. If everybody was observed for that long, it is the mean of min(escape
  /// time, until_s). Empty where the estimate is not known for so long, and without anybody.
  std::optional<double> restricted_mean_s(double until_s) const;
  /// Number of people observed for `after_s` who were still inside then, unhurt.
  int inside_after(double after_s) const;
  /// The share that has escaped after 0, 1, 2, ... s by the same estimate, as far as somebody was
  /// watched.
  std::vector<double> curve() const;

 private:
  std::vector<Watched> watched() const;
};

/// `end_s`: when the run ended.
EscapeTimes escape_times(const std::vector<PersonRecord>& people, double end_s);

nlohmann::json to_json(const EscapeTimes& times);
/// Throws nlohmann::json::exception for anything that to_json() does not write.
EscapeTimes escape_times_from(const nlohmann::json& value);

}  // namespace throng::metrics
