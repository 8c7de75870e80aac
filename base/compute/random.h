// Counter-based random numbers: a value depends only on (seed, stream, index, number of the call),
// so results do not depend on threads, shards or retries.
#pragma once

#include <array>
#include <cstdint>

namespace throng {

/// Purposes of random numbers. The values determine the bytes of output files and must not change.
enum class Stream : std::uint32_t {
  run = 1,              ///< seed of run i of a job
  crowd_generator = 2,  ///< start positions of agents
  crowd_profile = 3,    ///< properties of agents
  crowd_behavior = 4,   ///< goals, timers, targets
  appearance = 5,       ///< assignment of characters to agents
  motion = 6,           ///< gait phase and style
  wind = 7,
  sensors = 8,
  population = 9,  ///< bodies of a character library
  environment = 10,
  randomize = 11,     ///< values sampled for a job's distributions
  participants = 12,  ///< selection of the people who take part in a run
  crowd_arrivals = 13,
  crowd_groups = 14,  ///< social groups
  crowd_panic = 15,
  crowd_exits = 16,  ///< exits known to a person
  crowd_model = 17,  ///< noise of pedestrian models
  camera_noise = 18,
  perception = 24,  ///< counting errors of guides
  bootstrap = 25,   ///< resampling of statistics
  aim = 26,         ///< people at whom drones aim, and positions of the drones
  place = 27,       ///< scenarios generated for single runs of a job
  spectators = 28,  ///< seats, postures and departure of people on stands
};

/// A generator for the key (seed, stream, index): Philox 4x32-10 (Salmon et al. 2011) of Random123.
/// Cheap to construct: create one per agent, frame or decision.
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

/// Returns a 64-bit seed for part `index` of an object with this seed, e.g. for run 3 of a job.
std::uint64_t derive_seed(std::uint64_t seed, Stream stream, std::uint64_t index);

}  // namespace throng
