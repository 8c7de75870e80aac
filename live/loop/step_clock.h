// The times at which the steps of a flight are due.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace throng::live {

/// Not thread-safe.
class StepClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// The flight goes on after a rest: its next step is due now.
  void rest() {
    next_ = Clock::now();
    last_.reset();
    mean_step_s_.reset();
  }

  /// A step of this simulated time is done. The next one is due when that has passed at `factor`
  /// simulated seconds per second; 0: at once.
  void done(double dt_s, double factor);

  Clock::time_point next() const { return next_; }

  /// Simulated seconds per second that are reached lately; nothing after a rest.
  std::optional<double> reached_factor(double dt_s) const {
    if (!mean_step_s_) return std::nullopt;
    return dt_s / *mean_step_s_;
  }

  /// The simulated time to be shown now, in the step of `dt_s` that ends at `time_s`.
  double shown_time_s(double time_s, double dt_s) const {
    const double since_s = std::chrono::duration<double>(Clock::now() - stepped_).count();
    return std::min(time_s, time_s - dt_s + since_s * factor_);
  }

 private:
  Clock::time_point next_;
  Clock::time_point stepped_;              ///< time of the last step
  std::optional<Clock::time_point> last_;  ///< the same; none after a rest
  std::optional<double> mean_step_s_;      ///< lately; none after a rest
  double factor_ = 1;                      ///< of the last step
};

}  // namespace throng::live
