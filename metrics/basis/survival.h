// Survival analysis: estimates of the times until an event, with censored observations.
#pragma once

#include <optional>
#include <vector>

namespace throng::metrics {

/// The observation of one person: its duration, and whether the event happened at its end
/// (otherwise it is censored).
struct Watched {
  double time_s = 0;
  bool happened = false;
};

/// A step of the product-limit estimate: from `time_s` on, the share of people without the event.
struct Survival {
  double time_s = 0;
  double share = 1;
};

/// The product-limit estimate (Kaplan and Meier, J. Am. Stat. Assoc. 53, 1958): one element per
/// time of an event, in order. People censored at that time still count as observed.
std::vector<Survival> estimate_survival(std::vector<Watched> people);

/// The time by which the event has happened to `percent` % of the people: the first time at which
/// the product-limit estimate is at most 1 - percent / 100; nothing if there is none, or without
/// people. Without censoring, this is the ceil(percent * people / 100)-th time.
std::optional<double> time_by_which(const std::vector<Watched>& people, int percent);

/// The same if all `people` are observed until one time: `times_s` are the sorted times of the
/// events.
std::optional<double> time_by_which(const std::vector<double>& times_s, int people, int percent);

/// The restricted mean survival time: the area below the product-limit estimate from 0 to
/// `until_s`. Nothing without people, and if all observations end earlier with the estimate above
/// 0.
std::optional<double> restricted_mean_s(const std::vector<Watched>& people, double until_s);

}  // namespace throng::metrics
