#include "metrics/people/notification.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "metrics/basis/percents.h"

namespace throng::metrics {

using nlohmann::json;

namespace {

json percentiles_json(const std::vector<Watched>& people) {
  json result = json::object();
  for (const int percent : kPercents) {
    const auto time_s = time_by_which(people, percent);
    result[fmt::format("t{}_s", percent)] = time_s ? json(*time_s) : json(nullptr);
  }
  return result;
}

}  // namespace

Notification summarize_notification(const std::vector<PersonRecord>& people, double end_s) {
  Notification notification;
  for (const PersonRecord& person : people) {
    if (!person.is_evacuee()) continue;
    const double gone_s = person.escaped_s.value_or(end_s);
    notification.notice.push_back(
        {std::max(0.0, person.noticed_s.value_or(gone_s) - person.start_s),
         person.noticed_s.has_value()});
    if (!person.noticed_s) {
      ++notification.never;
      continue;
    }
    notification.times_s.push_back(*person.noticed_s - person.start_s);
    notification.first_s =
        std::min(notification.first_s.value_or(*person.noticed_s), *person.noticed_s);
    notification.escape.push_back({gone_s - *person.noticed_s, person.escaped_s.has_value()});
  }
  std::sort(notification.times_s.begin(), notification.times_s.end());
  return notification;
}

json to_json(const Notification& notification) {
  const std::vector<double>& times_s = notification.times_s;
  json first = nullptr;
  json mean = nullptr;
  if (!times_s.empty()) {
    first = *notification.first_s;
    mean =
        std::accumulate(times_s.begin(), times_s.end(), 0.0) / static_cast<double>(times_s.size());
  }
  return {{"noticed", times_s.size()},
          {"never", notification.never},
          {"first_s", std::move(first)},
          {"mean_s", std::move(mean)},
          {"percentiles", percentiles_json(notification.notice)},
          {"escape_after_notice", percentiles_json(notification.escape)}};
}

}  // namespace throng::metrics
