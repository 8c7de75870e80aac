// Menge's random numbers, for runs that reproduce published ones.
#pragma once

#include <cstdint>
#include <memory>

#include "crowd/agents/types.h"

namespace throng::crowd {

struct Distribution;

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

/// Creates the sequences of a run in the order in which elements request them: the first has the
/// run's seed + 1. Elements with their own seed do not count.
class MengeSequences {
 public:
  MengeSequences(Compat compat, std::uint64_t run_seed)
      : compatible_(compat != Compat::none), run_seed_(run_seed) {}

  /// Returns null if the run is not compatible or the distribution is constant.
  std::shared_ptr<MengeRandom> next(const Distribution& distribution);
  /// Returns null if the run is not compatible.
  std::shared_ptr<MengeRandom> next();
  /// Returns the sequence of a copied element: a new one with the original seed + 1.
  static std::shared_ptr<MengeRandom> copy(const std::shared_ptr<MengeRandom>& original);

  bool compatible() const { return compatible_; }
  std::uint64_t count() const { return count_; }
  /// Sets the number of the next sequence to count + 1, for elements that are read several times.
  void rewind(std::uint64_t count) { count_ = count; }

 private:
  bool compatible_;
  std::uint64_t run_seed_;
  std::uint64_t count_ = 0;
};

}  // namespace throng::crowd
