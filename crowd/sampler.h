// The random values of one element of the files.
#pragma once

#include <cstdint>

#include "crowd/distribution.h"

namespace throng::crowd {

/// Values of a distribution, one for each entry of an agent into a state. Ask when an agent enters
/// or leaves a state, not in between: then one thread at a time decides, in the order of ids,
/// which is what compatible runs draw by.
class Sampler {
 public:
  Sampler(const Distribution& distribution, Draws draws)
      : distribution_(distribution), draws_(draws) {}
  double operator()(std::size_t agent, std::uint32_t entry) {
    return distribution_.sample(draws_.at(agent, entry));
  }

 private:
  Distribution distribution_;
  Draws draws_;
};

/// The same for points.
class Sampler2 {
 public:
  Sampler2(const Distribution2& distribution, Draws draws)
      : distribution_(distribution), draws_(draws) {}
  Eigen::Vector2f operator()(std::size_t agent, std::uint32_t entry) {
    return distribution_.sample(draws_.at(agent, entry));
  }

 private:
  Distribution2 distribution_;
  Draws draws_;
};

}  // namespace throng::crowd
