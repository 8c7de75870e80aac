// Observer of a run that is simulated step by step: writes its trace and keeps its newest step.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "live/loop/moment.h"
#include "sim/recording/run_observer.h"
#include "world/trace.h"

namespace throng::live {

class RunRecorder : public sim::RunObserver {
 public:
  /// Writes the trace into this file, unless it is "".
  explicit RunRecorder(std::filesystem::path trace_file);
  ~RunRecorder() override;

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  void drone(std::size_t drone, const world::DroneSample& sample) override;
  void event(const world::TraceEvent& event) override;

  const world::TraceHeader& header() const { return header_; }
  /// The events since the last call.
  std::vector<world::TraceEvent> take_events();
  /// The newest step and the one before it, without the drones' status. It does not change when the
  /// run goes on.
  Moment moment(double dt_s) const;
  /// Forgets all samples of drones but the newest, before a step.
  void forget_samples();

  /// Completes the trace.
  void finish();

 private:
  std::filesystem::path trace_file_;
  world::TraceHeader header_;
  std::optional<world::TraceWriter> trace_;
  std::shared_ptr<const world::CrowdStep> before_;
  std::shared_ptr<const world::CrowdStep> now_;
  std::vector<float> strides_before_;  ///< meters walked
  std::vector<float> strides_now_;
  world::Trace flown_;
  std::vector<world::TraceEvent> events_;
};

}  // namespace throng::live
