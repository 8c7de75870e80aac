// Menge's random numbers, for runs that reproduce published ones.
#pragma once

#include <cstdint>

namespace throng::crowd {

/// A sequence of the minimal standard generator (Park and Miller 1988), 32-bit results. In Menge,
/// each element that samples has its own sequence, shared by all agents.
class MengeRandom {
 public:
  explicit MengeRandom(std::uint64_t seed);

  /// Uniform in (0, 1).
  double uniform();
  /// Standard normal (Box and Muller 1958); returns both values of a pair in turn.
  double normal();

  std::uint64_t seed() const { return seed_; }

 private:
  std::uint64_t seed_;
  std::uint32_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace throng::crowd
