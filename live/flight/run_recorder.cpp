#include "live/flight/run_recorder.h"

#include <utility>

namespace throng::live {

RunRecorder::RunRecorder(std::filesystem::path trace_file) : trace_file_(std::move(trace_file)) {}

RunRecorder::~RunRecorder() = default;

void RunRecorder::begin(const world::TraceHeader& header) {
  header_ = header;
  if (!trace_file_.empty()) trace_.emplace(trace_file_, header);
  flown_.header.drone_ids = header.drone_ids;
  flown_.drones.resize(header.drone_ids.size());
  strides_now_.resize(header.agent_count());
}

void RunRecorder::step(const world::CrowdStep& step) {
  if (trace_) trace_->add(step);
  before_ = std::exchange(now_, std::make_shared<const world::CrowdStep>(step));
  if (!before_) before_ = now_;
  strides_before_ = strides_now_;
  for (std::size_t i = 0; i < strides_now_.size(); ++i) {
    strides_now_[i] += (now_->position[i] - before_->position[i]).norm();
  }
}

void RunRecorder::drone(std::size_t drone, const world::DroneSample& sample) {
  if (trace_) trace_->add_drone(drone, sample);
  flown_.drones[drone].push_back(sample);
}

void RunRecorder::event(const world::TraceEvent& event) {
  if (trace_) trace_->add_event(event);
  events_.push_back(event);
}

std::vector<world::TraceEvent> RunRecorder::take_events() { return std::exchange(events_, {}); }

Moment RunRecorder::moment(double dt_s) const {
  Moment moment;
  moment.time_s = now_->time_s;
  moment.dt_s = dt_s;
  moment.before = before_;
  moment.now = now_;
  moment.strides_before = strides_before_;
  moment.strides_now = strides_now_;
  moment.flown = flown_;
  return moment;
}

void RunRecorder::forget_samples() {
  for (std::vector<world::DroneSample>& samples : flown_.drones) {
    if (samples.size() > 1) samples.erase(samples.begin(), samples.end() - 1);
  }
}

void RunRecorder::finish() {
  if (trace_) trace_->finish();
}

}  // namespace throng::live
