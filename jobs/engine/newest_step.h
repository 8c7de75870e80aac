// Observer of a run that keeps its newest step, and writes the trace where it is asked to.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "jobs/engine/stepped_job.h"
#include "jobs/live/flight.h"
#include "sim/run_observer.h"
#include "world/trace.h"

namespace throng::engine {

/// The arrays of people() and the rows of drones() keep their addresses while the run goes on.
class NewestStep : public sim::RunObserver {
 public:
  /// Writes a trace into `trace_file`, unless it is "".
  explicit NewestStep(std::filesystem::path trace_file);
  ~NewestStep() override;

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  void drone(std::size_t drone, const world::DroneSample& sample) override;
  void event(const world::TraceEvent& event) override;

  const world::TraceHeader& header() const { return header_; }
  const world::CrowdStep& people() const { return *people_; }
  const DroneRows& drones() const { return drones_; }
  std::vector<world::TraceEvent> take_events();

  /// The newest step and the one before it, for cameras; without the drones' status.
  live::Moment moment(double dt_s) const;
  /// Forgets all samples of drones but the newest, before a step.
  void forget_samples();

  /// Completes the trace.
  void finish();

 private:
  std::filesystem::path trace_file_;
  std::optional<world::TraceWriter> trace_;
  world::TraceHeader header_;
  std::shared_ptr<world::CrowdStep> before_;
  std::shared_ptr<world::CrowdStep> people_;
  std::vector<float> strides_before_;  ///< meters walked
  std::vector<float> strides_now_;
  DroneRows drones_;
  world::Trace flown_;
  std::vector<world::TraceEvent> events_;
};

}  // namespace throng::engine
