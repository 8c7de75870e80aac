// Interface of recorders, which write a run while it is simulated.
#pragma once

#include "crowd/simulation.h"

namespace throng::crowd {

/// Writes one file from a running simulation.
class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Writes the current state of the crowd. Called at time 0 and after each step. Throws
  /// EnvironmentError.
  virtual void record(const Simulation& crowd) = 0;
  /// Completes the file and moves it to its final name. Called once, after the last record();
  /// without this call, no file is left. Throws EnvironmentError.
  virtual void finish(const Simulation& crowd) = 0;
};

}  // namespace throng::crowd
