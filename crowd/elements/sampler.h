// Sampling of the random values of one element.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "crowd/elements/distribution.h"
#include "crowd/elements/menge_random.h"

namespace throng::crowd {

/// Samples a distribution, once per entry of an agent into a state. Must be called when an agent
/// enters or leaves a state: one thread then handles agents in the order of their ids, on which
/// compatible runs depend. Copies share the sequence.
class Sampler {
 public:
  /// `sequence` is Menge's sequence in compatible runs, else null.
  Sampler(const Distribution& distribution, Draws draws,
          std::shared_ptr<MengeRandom> sequence = nullptr)
      : distribution_(distribution), draws_(draws), sequence_(std::move(sequence)) {}
  double operator()(std::size_t agent, std::uint32_t entry) {
    return sequence_ ? distribution_.sample(*sequence_)
                     : distribution_.sample(draws_.at(agent, entry));
  }

 private:
  Distribution distribution_;
  Draws draws_;
  std::shared_ptr<MengeRandom> sequence_;
};

/// Samples points; in compatible runs, each coordinate has its own sequence.
class Sampler2 {
 public:
  Sampler2(const Distribution2& distribution, Draws draws, std::shared_ptr<MengeRandom> x = nullptr,
           std::shared_ptr<MengeRandom> y = nullptr)
      : distribution_(distribution), draws_(draws), x_(std::move(x)), y_(std::move(y)) {}
  Eigen::Vector2f operator()(std::size_t agent, std::uint32_t entry) {
    return x_ && y_ ? distribution_.sample(*x_, *y_)
                    : distribution_.sample(draws_.at(agent, entry));
  }

 private:
  Distribution2 distribution_;
  Draws draws_;
  std::shared_ptr<MengeRandom> x_;
  std::shared_ptr<MengeRandom> y_;
};

}  // namespace throng::crowd
