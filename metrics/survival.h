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

/// The time by which it has happened to `percent` % of all people: the least time at which the
/// product-limit estimate of those to whom it has not is down to the rest (Kaplan and Meier, J. Am.
/// Stat. Assoc. 53, 1958). Empty where the estimate does not come down to it, and without people.
/// Where it happened to everybody this is the ceil(percent * people / 100)-th time.
std::optional<double> time_by_which(std::vector<Watched> people, int percent);

/// The same where all are watched until one time: `times_s` are in order and of those of `people`
/// to whom it happened.
std::optional<double> time_by_which(const std::vector<double>& times_s, int people, int percent);

}  // namespace throng::metrics
