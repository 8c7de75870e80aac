// The job that repeats a flight.
#pragma once

#include "sim/remote/remote_pilots.h"
#include "spec/job/spec.h"

namespace throng::live {

/// The job whose drones fly the logged set-points: one run, which ends when the flight did. Its
/// trace is that of the flight.
jobs::JobSpec replay_job(const jobs::JobSpec& flown, const sim::RemotePilots& pilots,
                         double duration_s);

}  // namespace throng::live
