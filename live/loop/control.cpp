#include "live/loop/control.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.h"
#include "world/trace.h"

namespace throng::live {

namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

Control::Control(std::vector<std::string> drones, const Pace& pace, std::stop_token stop)
    : drones_(std::move(drones)),
      max_s_(pace.max_s),
      stop_(std::move(stop)),
      commanded_s_(drones_.size(), kNever),
      is_watched_(pace.is_watched) {
  input_.commands.resize(drones_.size());
  input_.factor = pace.factor;
  input_.paused = pace.paused;
}

void Control::command(const Commands& commands) {
  const std::lock_guard lock(mutex_);
  merge(commands, drones_, input_);
  for (const DroneCommand& drone : commands.drones) {
    if (!drone.velocity_mps && !drone.yaw_rate_deg_s) continue;
    const auto found = std::find(drones_.begin(), drones_.end(), drone.id);
    commanded_s_.at(static_cast<std::size_t>(found - drones_.begin())) = moment_->time_s;
  }
  changed_.notify_all();
}

void Control::step(std::int64_t steps, Answer answer) {
  const std::lock_guard lock(mutex_);
  if (!input_.paused) {
    throw InputError({"/throng/step", "", "a flight that is not paused",
                      "one that is (/throng/pause, or the parameter paused)"});
  }
  goal_ = std::max(goal_, steps_) + static_cast<std::uint64_t>(steps);
  waiting_.push_back({goal_, std::move(answer)});
  changed_.notify_all();
}

void Control::reset(std::optional<std::uint64_t> seed, Answer answer) {
  const std::lock_guard lock(mutex_);
  if (reset_) throw InputError({"/throng/reset", "", "a reset that is under way", "one at a time"});
  reset_ = Reset{seed, std::move(answer)};
  changed_.notify_all();
}

void Control::watch(bool is_watched) {
  const std::lock_guard lock(mutex_);
  is_watched_ = is_watched;
  changed_.notify_all();
}

bool Control::is_watched() const {
  const std::lock_guard lock(mutex_);
  return is_watched_;
}

void Control::end() {
  const std::lock_guard lock(mutex_);
  ends_ = true;
  changed_.notify_all();
}

void Control::fail(std::exception_ptr problem) {
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
  changed_.notify_all();
}

PilotInput Control::input() const {
  const std::lock_guard lock(mutex_);
  return input_;
}

double Control::time_s() const {
  const std::lock_guard lock(mutex_);
  return moment_->time_s;
}

double Control::reached_factor() const {
  const std::lock_guard lock(mutex_);
  return clock_.reached_factor(moment_->dt_s).value_or(input_.factor);
}

void Control::begin(std::shared_ptr<const Moment> moment) {
  const std::lock_guard lock(mutex_);
  input_.commands.assign(drones_.size(), {});
  commanded_s_.assign(drones_.size(), kNever);
  moment_ = std::move(moment);
  is_at_rest_ = false;
  clock_ = StepClock();
  clock_.rest();
}

Turn Control::wait_for_turn() {
  std::unique_lock lock(mutex_);
  while (true) {
    if (problem_) std::rethrow_exception(problem_);
    if (should_end()) return Turn::end;
    if (reset_) return Turn::reset;
    if (moment_->time_s + moment_->dt_s > max_s_ + world::kTimeSlackS) return Turn::end;
    if (steps_ < goal_ || (!rests() && input_.factor == 0)) return Turn::step;
    if (rests()) {
      if (!std::exchange(is_at_rest_, true)) return Turn::rest;
      changed_.wait(lock, stop_,
                    [this] { return !rests() || steps_ < goal_ || reset_ || should_end(); });
      clock_.rest();
      continue;
    }
    if (StepClock::Clock::now() >= clock_.next()) return Turn::step;
    changed_.wait_until(lock, stop_, clock_.next(),
                        [this] { return rests() || input_.factor == 0 || reset_ || should_end(); });
  }
}

PilotInput Control::in_force() const {
  const std::lock_guard lock(mutex_);
  PilotInput input = input_;
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    const double silence_s = moment_->time_s - commanded_s_[i];
    if (silence_s > kSilenceS - world::kTimeSlackS) stop_moving(input.commands[i]);
  }
  return input;
}

void Control::done(std::shared_ptr<const Moment> moment) {
  std::vector<Waiting> ready;
  double time_s = 0;
  {
    const std::lock_guard lock(mutex_);
    moment_ = std::move(moment);
    time_s = moment_->time_s;
    ++steps_;
    is_at_rest_ = false;
    clock_.done(moment_->dt_s, input_.factor);
    const auto first =
        std::stable_partition(waiting_.begin(), waiting_.end(),
                              [this](const Waiting& each) { return each.step > steps_; });
    ready.assign(std::make_move_iterator(first), std::make_move_iterator(waiting_.end()));
    waiting_.erase(first, waiting_.end());
  }
  for (const Waiting& each : ready) each.answer("", time_s);
}

Control::Reset Control::take_reset() {
  const std::lock_guard lock(mutex_);
  check(reset_.has_value(), "a reset was asked for");
  goal_ = steps_;
  return *std::exchange(reset_, std::nullopt);
}

void Control::refuse_all(const std::string& problem) {
  std::vector<Waiting> waiting;
  std::optional<Reset> reset;
  double time_s = 0;
  {
    const std::lock_guard lock(mutex_);
    waiting.swap(waiting_);
    reset.swap(reset_);
    time_s = moment_->time_s;
  }
  for (const Waiting& each : waiting) each.answer(problem, time_s);
  if (reset) reset->answer(problem, time_s);
}

Control::Shown Control::shown() const {
  const std::lock_guard lock(mutex_);
  if (rests() || input_.factor == 0) return {moment_, moment_->time_s};
  return {moment_, clock_.shown_time_s(moment_->time_s, moment_->dt_s)};
}

}  // namespace throng::live
