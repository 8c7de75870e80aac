// Sequences of Menge's random numbers, for runs that reproduce published ones.
#pragma once

#include <cstdint>
#include <memory>

#include "crowd/agents/types.h"
#include "crowd/elements/distribution.h"
#include "crowd/elements/menge_random.h"

namespace throng::crowd {

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
