// Interface of recorders, which write a run while it proceeds.
#pragma once

#include "crowd/simulation.h"

namespace throng::crowd {

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Writes the crowd as it is now: at time 0 and after every step. Throws EnvironmentError.
  virtual void record(const Simulation& crowd) = 0;
  /// Completes the file and gives it its name after the last record() of the same crowd; without
  /// it nothing is left behind. Throws EnvironmentError.
  virtual void finish(const Simulation& crowd) = 0;
};

}  // namespace throng::crowd
