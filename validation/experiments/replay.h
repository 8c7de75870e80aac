// Replays of experiments with pedestrian models.
#pragma once

#include <cstdint>
#include <stop_token>

#include "validation/experiments/experiment.h"
#include "validation/experiments/walks.h"
#include "validation/scene.h"

namespace throng::validation {

/// An experiment with its recording, ready to be repeated with models.
class Replay {
 public:
  /// Reads the recording. Throws InputError and EnvironmentError, also if nobody is seen on the
  /// ground, if the steady state is not in the recording, or if that lasts longer than two hours.
  explicit Replay(Experiment experiment);

  const Experiment& experiment() const { return experiment_; }
  /// The people of the recording.
  const Measures& recorded() const { return recorded_; }
  /// Simulates the experiment. Recordings: everybody enters where and when they were first seen, or
  /// as soon afterwards as there is space, and the run ends when all have reached their goal, or
  /// after three times the duration of the recording. Closed corridors: people walk around in a
  /// ring of the same length and width and are measured from 20 to 50 s. Quantities are those of
  /// recorded(), in the same order. Throws Cancelled when `stop` is requested.
  Measures simulate(const Tested& tested, std::uint64_t seed,
                    const std::stop_token& stop = {}) const;

 private:
  Measures walk_around(const Tested& tested, std::uint64_t seed) const;

  Experiment experiment_;
  Walks walks_;
  TimeRange steady_;
  Loop loop_;  // of experiments in closed corridors
  Measures recorded_;
};

/// Simulates a recording with a model. Throws Cancelled when `stop` is requested.
Walks replayed_walks(const Recording& recording, const Walks& recorded,
                     const FreeSpeeds& free_speeds, const Tested& tested, std::uint64_t seed,
                     const std::stop_token& stop = {});

}  // namespace throng::validation
