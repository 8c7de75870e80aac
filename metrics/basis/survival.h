// Times until something happens to people, some of whom were not watched until it did.
#pragma once

#include <optional>
#include <vector>

namespace throng::metrics {

/// How long one person was watched, and whether it happened at the end of that.
struct Watched {
  double time_s = 0;
  bool happened = false;
};

/// A step of the product-limit estimate: the share to whom it has not happened from `time_s` on.
struct Survival {
  double time_s = 0;
  double share = 1;
};

/// The product-limit estimate (Kaplan and Meier, J. Am. Stat. Assoc. 53, 1958): one entry per time
/// at which it happened to somebody, in order. People censored at that time still count as observed
/// then.
std::vector<Survival> estimate_survival(std::vector<Watched> people);

/// The time by which it has happened to `percent` % of all people: the least time at which the
/// product-limit estimate is down to the rest. Empty where the estimate does not come down to it,
/// and without people. If it happened to everybody, this is the ceil(percent * people / 100)-th
/// time.
std::optional<double> time_by_which(const std::vector<Watched>& people, int percent);

/// The same where all are watched until one time: `times_s` are in order and of those of `people`
/// to whom it happened.
std::optional<double> time_by_which(const std::vector<double>& times_s, int people, int percent);

/// Restricted mean survival time: the area below the product-limit estimate from 0 to `until_s`.
/// Empty without people, and where the estimate is above 0 and everybody's watch ended before.
std::optional<double> restricted_mean_s(const std::vector<Watched>& people, double until_s);

}  // namespace throng::metrics
