// The newest step of a run, in arrays that keep their addresses.
#pragma once

#include "live/engine/drone_rows.h"
#include "live/flight/run_recorder.h"
#include "world/trace.h"

namespace throng::engine {

class NewestStep : public live::RunRecorder {
 public:
  using RunRecorder::RunRecorder;

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  void drone(std::size_t drone, const world::DroneSample& sample) override;

  /// Its arrays keep their addresses while the run goes on, and so do the rows of drones().
  const world::CrowdStep& people() const { return people_; }
  const DroneRows& drones() const { return drones_; }

 private:
  world::CrowdStep people_;
  DroneRows drones_;
};

}  // namespace throng::engine
