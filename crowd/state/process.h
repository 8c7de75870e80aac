// Processes that run in each step beside the agents' decisions: moving goals, events, stress,
// arrivals.
#pragma once

#include "crowd/state/crowd.h"

namespace throng::crowd {

class Machine;

/// A process, called once per (sub-)step by one thread, in the order of the files.
class Process {
 public:
  virtual ~Process() = default;
  /// Called once, when all have entered their initial states and before they look where to go; not
  /// in a crowd that cannot step.
  virtual void before_start(const Crowd&) {}
  /// Called before the agents decide; `crowd.time_s()` is the time at the start of the step.
  virtual void before_decisions(Crowd&, Machine&) {}
  /// Called after the agents have moved; `crowd.time_s()` is the time at the end of the step.
  virtual void after_motion(Crowd&, Machine&) {}
};

}  // namespace throng::crowd
