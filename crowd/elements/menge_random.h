// Random numbers as Menge draws them, for runs that are to repeat published ones.
#pragma once

#include <cstdint>
#include <memory>

#include "crowd/types.h"

namespace throng::crowd {

struct Distribution;

/// One sequence: the minimal standard generator (Park, Miller 1988), 32-bit results. Menge gives
/// each element of the files that draws one of its own, shared by all agents.
class MengeRandom {
 public:
  explicit MengeRandom(std::uint64_t seed);

  /// Uniform in (0, 1).
  double uniform();
  /// Standard normal (Box, Muller 1958), both values of a pair in turn.
  double normal();

  std::uint64_t seed() const { return seed_; }

 private:
  std::uint64_t seed_;
  std::uint32_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// Hands out the sequences of a run in the order in which the files' elements ask: the first has
/// the run's seed + 1. Elements that give a seed of their own do not count.
class MengeSequences {
 public:
  MengeSequences(Compat compat, std::uint64_t run_seed)
      : compatible_(compat != Compat::none), run_seed_(run_seed) {}

  /// Null where runs are not compatible, or nothing is to be sampled.
  std::shared_ptr<MengeRandom> next(const Distribution& distribution);
  /// Null where runs are not compatible.
  std::shared_ptr<MengeRandom> next();
  /// The generator of an element that is the copy of another one: its own sequence, with the seed
  /// + 1.
  static std::shared_ptr<MengeRandom> copy(const std::shared_ptr<MengeRandom>& original);

  bool compatible() const { return compatible_; }
  std::uint64_t count() const { return count_; }
  /// Makes the next() be the count-th + 1 again, for elements that are read several times.
  void rewind(std::uint64_t count) { count_ = count; }

 private:
  bool compatible_;
  std::uint64_t run_seed_;
  std::uint64_t count_ = 0;
};

}  // namespace throng::crowd
