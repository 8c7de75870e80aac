// The interface that receives the states and events of a run.
#pragma once

#include <cstddef>

#include "spec/sim/run_spec.h"
#include "world/trace.h"

namespace throng::sim {

/// Observer of a run. All methods are called from the simulating thread.
class RunObserver {
 public:
  RunObserver() = default;
  virtual ~RunObserver() = default;
  RunObserver(const RunObserver&) = delete;
  RunObserver& operator=(const RunObserver&) = delete;

  virtual void begin(const world::TraceHeader&) {}
  virtual void step(const world::CrowdStep&) {}
  virtual void drone(std::size_t /*drone*/, const world::DroneSample&) {}
  virtual void event(const world::TraceEvent&) {}
  /// Receives the set-point of a drone and whether it leads, once per step of the crowd.
  virtual void pilot(std::size_t /*drone*/, const PilotSample&) {}
  /// Whether the run may end early.
  virtual bool done() const { return false; }
};

}  // namespace throng::sim
