// Processes beside the agents' own decisions: moving goals, events, stress, sources.
#pragma once

#include "crowd/crowd.h"

namespace throng::crowd {

class Machine;

/// Called once per (sub-)step by one thread, in the order of the files.
class Process {
 public:
  virtual ~Process() = default;
  /// Before the agents decide. time is crowd.time_s().
  virtual void before_decisions(Crowd&, Machine&) {}
  /// After they have moved, at the end of the step; crowd.time_s() is the new time.
  virtual void after_motion(Crowd&, Machine&) {}
};

}  // namespace throng::crowd
