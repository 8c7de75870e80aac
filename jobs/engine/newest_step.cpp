#include "jobs/engine/newest_step.h"

#include <utility>

namespace throng::engine {

NewestStep::NewestStep(std::filesystem::path trace_file) : trace_file_(std::move(trace_file)) {}

NewestStep::~NewestStep() = default;

void NewestStep::begin(const world::TraceHeader& header) {
  header_ = header;
  if (!trace_file_.empty()) trace_.emplace(trace_file_, header);
  flown_.header.drone_ids = header.drone_ids;
  flown_.drones.resize(header.drone_ids.size());
  drones_ = DroneRows::Zero(static_cast<Eigen::Index>(header.drone_ids.size()),
                            DroneRows::ColsAtCompileTime);
  strides_now_.resize(header.agent_count());
}

void NewestStep::step(const world::CrowdStep& step) {
  if (trace_) trace_->add(step);
  if (people_) {
    *before_ = *people_;
    *people_ = step;
  } else {
    people_ = std::make_shared<world::CrowdStep>(step);
    before_ = std::make_shared<world::CrowdStep>(step);
  }
  strides_before_ = strides_now_;
  for (std::size_t i = 0; i < strides_now_.size(); ++i) {
    strides_now_[i] += (people_->position[i] - before_->position[i]).norm();
  }
}

void NewestStep::drone(std::size_t drone, const world::DroneSample& sample) {
  if (trace_) trace_->add_drone(drone, sample);
  flown_.drones[drone].push_back(sample);
  const Eigen::Quaterniond& turn = sample.orientation;
  drones_.row(static_cast<Eigen::Index>(drone)) << sample.position.transpose(),
      sample.velocity.transpose(), turn.w(), turn.x(), turn.y(), turn.z(),
      sample.body_rates.transpose();
}

void NewestStep::event(const world::TraceEvent& event) {
  if (trace_) trace_->add_event(event);
  events_.push_back(event);
}

std::vector<world::TraceEvent> NewestStep::take_events() { return std::exchange(events_, {}); }

live::Moment NewestStep::moment(double dt_s) const {
  live::Moment moment;
  moment.time_s = people_->time_s;
  moment.dt_s = dt_s;
  moment.before = before_;
  moment.now = people_;
  moment.strides_before = strides_before_;
  moment.strides_now = strides_now_;
  moment.flown = flown_;
  return moment;
}

void NewestStep::forget_samples() {
  for (std::vector<world::DroneSample>& samples : flown_.drones) {
    if (samples.size() > 1) samples.erase(samples.begin(), samples.end() - 1);
  }
}

void NewestStep::finish() {
  if (trace_) trace_->finish();
}

}  // namespace throng::engine
