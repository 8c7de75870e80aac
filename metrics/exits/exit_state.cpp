#include "metrics/exits/exit_state.h"

#include <algorithm>

#include "world/trace.h"

namespace throng::metrics {

namespace {

constexpr double kSpecificFlow = 1.3;  // people per meter and second

constexpr double kCongestedDensity = 0.35;  // of close packing
constexpr double kCongestedSpeed = 0.3;     // of the desired speed
constexpr double kRelievedDensity = 0.25;
constexpr double kRelievedSpeed = 0.4;
constexpr double kReliefS = 1.0;

constexpr double kFullDensity = 0.6;  // density at which the clogging index saturates
constexpr double kFreeSpeed = 0.6;    // of the desired speed: no slower than a free crowd

}  // namespace

double capacity_per_s(const world::Exit& exit) {
  return exit.capacity ? exit.capacity->per_s_at(exit.width_m()) : kSpecificFlow * exit.width_m();
}

std::string capacity_source(const world::Exit& exit) {
  return exit.capacity ? exit.capacity->text() : "nominal";
}

double clogging_index(const ExitSample& sample, const ExitDemand& demand, double capacity_per_s) {
  if (!demand.demand) return 0;
  const double density = std::min(1.0, sample.normalized_density / kFullDensity);
  const double flow_lack = std::clamp(1 - sample.flow_per_s / capacity_per_s, 0.0, 1.0);
  // Without anybody who wants to move, nobody is held up.
  const double free_speed = kFreeSpeed * demand.desired_speed_mps;
  const double speed_lack =
      free_speed > 0 ? std::clamp(1 - sample.approach_speed_mps / free_speed, 0.0, 1.0) : 0.0;
  return density * (0.5 * flow_lack + 0.5 * speed_lack);
}

double clog_after_s(double capacity_per_s) { return std::max(2.0, 3.0 / capacity_per_s); }

ExitStateMachine::ExitStateMachine(double capacity_per_s)
    : clog_after_s_(clog_after_s(capacity_per_s)) {}

ExitState ExitStateMachine::step(double time_s, bool open, const ExitSample& sample,
                                 const ExitDemand& demand) {
  if (!open) return state_ = ExitState::closed;
  const ExitState before = state_;
  if (demand.demand && before == ExitState::idle) demand_since_s_ = time_s;
  state_ = demand.demand ? next(time_s, sample, demand) : ExitState::idle;
  if (state_ < ExitState::congested) relief_since_s_ = -1;
  return state_;
}

ExitState ExitStateMachine::next(double time_s, const ExitSample& sample,
                                 const ExitDemand& demand) {
  if (state_ < ExitState::congested) {
    const bool jams = sample.normalized_density >= kCongestedDensity &&
                      sample.approach_speed_mps < kCongestedSpeed * demand.desired_speed_mps;
    if (!jams) return ExitState::flowing;
  } else if (relieved(time_s, sample, demand)) {
    return ExitState::flowing;
  }
  // A door that nobody wanted to pass was not blocked: the gap starts with the demand.
  const double gap_s = std::min(sample.since_crossing_s, time_s - demand_since_s_);
  return gap_s >= clog_after_s_ - world::kTimeSlackS ? ExitState::clogged : ExitState::congested;
}

// Whether the jam has been over for long enough.
bool ExitStateMachine::relieved(double time_s, const ExitSample& sample, const ExitDemand& demand) {
  const bool relief = sample.approach_speed_mps > kRelievedSpeed * demand.desired_speed_mps ||
                      sample.normalized_density < kRelievedDensity;
  if (!relief) {
    relief_since_s_ = -1;
    return false;
  }
  if (relief_since_s_ < 0) relief_since_s_ = time_s;
  return time_s - relief_since_s_ >= kReliefS - world::kTimeSlackS;
}

}  // namespace throng::metrics
