// Counter-based random numbers: a value depends only on (seed, stream, index, draw), never on the
// order in which others sample, so results do not change with threads, shards or retries.
#pragma once

#include <array>
#include <cstdint>

namespace throng {

/// One stream per purpose; the number is part of every file's bytes, so never renumber.
enum class Stream : std::uint32_t {
  run = 1,              ///< seed of run i of a job
  crowd_generator = 2,  ///< where agents start
  crowd_profile = 3,    ///< agents' properties
  crowd_behavior = 4,   ///< goals, timers, targets
  appearance = 5,       ///< who looks like what
  motion = 6,           ///< gait phase and style
  wind = 7,
  sensors = 8,
  population = 9,  ///< bodies that are baked
  environment = 10,
  randomize = 11,     ///< values sampled for a job's distributions
  participants = 12,  ///< who of a scenario's people takes part in a run
  crowd_arrivals = 13,
  crowd_groups = 14,  ///< who walks with whom
  crowd_panic = 15,
  crowd_exits = 16,  ///< which exits somebody knows
  crowd_model = 17,  ///< noise of pedestrian models
  camera_noise = 18,
  perception = 24,  ///< what guides count wrongly
  bootstrap = 25,   ///< resampling of statistics
  aim = 26,         ///< people at whom drones aim, and from where
  place = 27,       ///< places generated for single runs of a job
};

/// A generator keyed by (seed, stream, index): Philox 4x32-10 (Salmon et al. 2011) from Random123.
/// Cheap to construct: make one per agent, frame or decision, and throw it away.
class Random {
 public:
  Random(std::uint64_t seed, Stream stream, std::uint64_t index = 0);

  /// Uniform over all 32-bit values.
  std::uint32_t bits();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Normal with the given mean and standard deviation (Box-Muller).
  double normal(double mean, double sd);
  /// Uniform integer in [0, count); count > 0.
  std::uint32_t below(std::uint32_t count);

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
};

/// A 64-bit seed for part `index` of something with this seed, e.g. run 3 of a job.
std::uint64_t derive_seed(std::uint64_t seed, Stream stream, std::uint64_t index);

}  // namespace throng
