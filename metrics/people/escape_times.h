// Escape times of people, each from the later of alarm and arrival. Both the metrics of a trace and
// studies are based on them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/survival.h"

namespace throng::metrics {

/// The escape times of a run, with censored observations.
struct EscapeTimes {
  int people = 0;             ///< all people who were present at any time
  int left_before_alarm = 0;  ///< people who left before the alarm; no evacuees
  int turned_back = 0;        ///< people who came to an exit and did not enter; no evacuees
  int never_inside = 0;       ///< other people who were never inside; no evacuees
  int vanished = 0;           ///< number of `inside_s` that end when the person vanished
  /// Sorted escape times of the people who escaped (s).
  std::vector<double> escape_s;
  /// Sorted observation times of the people who were inside, unhurt, when last observed (s).
  std::vector<double> inside_s;
  /// A casualty inside at the end.
  struct Casualty {
    double watched_s = 0;
    double hurt_s = 0;  ///< time of the injury, also from the later of alarm and arrival
  };
  std::vector<Casualty> casualties;  ///< sorted by `hurt_s`

  /// Number of people whose escape is measured: who were inside and did not leave before the alarm.
  int evacuees() const {
    return static_cast<int>(escape_s.size() + inside_s.size() + casualties.size());
  }
  /// Number of people inside at the end, unhurt.
  int not_escaped() const { return static_cast<int>(inside_s.size()) - vanished; }
  /// The ceil(percent * evacuees / 100)-th escape time; nothing if fewer escaped.
  std::optional<double> percentile_s(int percent) const;
  /// Mean escape time, where people who did not escape count with their observation time; 0 without
  /// evacuees.
  double mean_censored_s() const;
  /// The restricted mean survival time: the area below the curve of the share still inside, up to
  /// `until_s` (Royston and Parmar, BMC Med. Res. Methodol. 13, 2013). The share is the
  /// product-limit estimate of unhurt people plus the casualties, who stay. If all people are
  /// observed for that long, it is the mean of min(escape time, until_s). Nothing if the estimate
  /// does not reach that far, and without evacuees.
  std::optional<double> restricted_mean_s(double until_s) const;
  /// Number of people observed for at least `after_s` who were still inside, unhurt, at that time.
  int inside_after(double after_s) const;
  /// The share that has escaped by 0, 1, 2, ... s, by the estimate of restricted_mean_s(), up to
  /// the longest observation.
  std::vector<double> curve() const;

 private:
  std::vector<Watched> watched() const;
};

/// The escape times of people; `end_s` is the end of the run.
EscapeTimes escape_times(const std::vector<PersonRecord>& people, double end_s);

nlohmann::json to_json(const EscapeTimes& times);
/// The inverse of to_json(). Throws nlohmann::json::exception for other values.
EscapeTimes escape_times_from(const nlohmann::json& value);

}  // namespace throng::metrics
