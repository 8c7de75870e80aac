#include "live/loop/step_clock.h"

namespace throng::live {

void StepClock::done(double dt_s, double factor) {
  constexpr double kNew = 0.1;  // share of the newest in the mean
  constexpr std::chrono::milliseconds kMaxLate(50);
  const Clock::time_point now = Clock::now();
  stepped_ = now;
  factor_ = factor;
  if (last_ && now > *last_) {
    const double step_s = std::chrono::duration<double>(now - *last_).count();
    mean_step_s_ = mean_step_s_ ? *mean_step_s_ + kNew * (step_s - *mean_step_s_) : step_s;
  }
  last_ = now;
  if (factor > 0) {
    next_ +=
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(dt_s / factor));
  }
  // A machine that is too slow flies slower, and does not catch up.
  next_ = std::max(next_, now - kMaxLate);
}

}  // namespace throng::live
