#include "sim/recording/trace_recorder.h"

#include "base/files/files.h"
#include "sim/recording/pilot_log.h"

namespace throng::sim {

TraceRecorder::TraceRecorder(std::filesystem::path trace_file,
                             std::filesystem::path pilot_log_folder)
    : trace_file_(std::move(trace_file)), pilot_log_folder_(std::move(pilot_log_folder)) {}

void TraceRecorder::begin(const world::TraceHeader& header) {
  trace_.emplace(trace_file_, header);
  drone_ids_ = header.drone_ids;
  pilot_logs_.resize(drone_ids_.size());
}

void TraceRecorder::step(const world::CrowdStep& step) { trace_->add(step); }

void TraceRecorder::drone(std::size_t drone, const world::DroneSample& sample) {
  trace_->add_drone(drone, sample);
}

void TraceRecorder::event(const world::TraceEvent& event) { trace_->add_event(event); }

void TraceRecorder::pilot(std::size_t drone, const PilotSample& sample) {
  if (!pilot_log_folder_.empty()) pilot_logs_[drone].push_back(sample);
}

void TraceRecorder::finish() {
  if (!pilot_log_folder_.empty()) {
    for (std::size_t i = 0; i < drone_ids_.size(); ++i) {
      write_file_atomically(pilot_log_folder_ / (drone_ids_[i] + ".csv"),
                            pilot_log_csv(pilot_logs_[i]));
    }
  }
  trace_->finish();
}

}  // namespace throng::sim
