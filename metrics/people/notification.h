// When people noticed the alarm, and what came after.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/survival.h"

namespace throng::metrics {

/// When evacuees noticed the alarm. Evacuees are all people but those who left before it.
struct Notification {
  int never = 0;                  ///< people who did not, in the time that the run had
  std::vector<double> times_s;    ///< of the others, from the later of alarm and arrival, in order
  std::optional<double> first_s;  ///< the earliest of all, by the run's clock
  /// Times of all evacuees since the alarm, until they noticed it, escaped without noticing, or the
  /// run ended.
  std::vector<Watched> notice;
  /// Times of evacuees since they noticed the alarm, until they escaped or the run ended.
  std::vector<Watched> escape;
};

/// `end_s`: when the run ended.
Notification summarize_notification(const std::vector<PersonRecord>& people, double end_s);

nlohmann::json to_json(const Notification& notification);

}  // namespace throng::metrics
