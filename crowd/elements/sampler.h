// The random values of one element of the files.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "crowd/elements/distribution.h"
#include "crowd/elements/menge_random.h"

namespace throng::crowd {

/// Values of a distribution, one for each entry of an agent into a state. Ask when an agent enters
/// or leaves a state, not in between: then one thread at a time decides, in the order of ids,
/// which is what compatible runs draw by. Copies go on with the same random numbers.
class Sampler {
 public:
  /// `sequence` is what compatible runs draw from, null in others.
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

/// The same for points; each coordinate has a sequence of its own.
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
