// When people noticed the alarm, and when they escaped after that.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/survival.h"

namespace throng::metrics {

/// Notification of the evacuees (PersonRecord::is_evacuee()).
struct Notification {
  int never = 0;  ///< evacuees who did not notice the alarm during the run
  /// Times of the other evacuees from the later of alarm and arrival, sorted.
  std::vector<double> times_s;
  std::optional<double> first_s;  ///< earliest time, by the run's clock
  /// Times of all evacuees from the later of alarm and arrival until they noticed the alarm
  /// (event), escaped without noticing, or the run ended.
  std::vector<Watched> notice;
  /// Times of evacuees from noticing the alarm until they escaped (event) or the run ended.
  std::vector<Watched> escape;
};

/// Summarizes the notification of people; `end_s` is the end of the run.
Notification summarize_notification(const std::vector<PersonRecord>& people, double end_s);

nlohmann::json to_json(const Notification& notification);

}  // namespace throng::metrics
