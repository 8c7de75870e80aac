// Random values as the XML writes them: dist="c" value, dist="u" min max, dist="n" mean stddev.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/random.h"
#include "crowd/menge_random.h"

namespace throng::crowd {

/// A distribution of numbers. Normal values are cut off at three standard deviations.
struct Distribution {
  enum class Kind { constant, uniform, normal };

  Kind kind = Kind::constant;
  double first = 0;   ///< value, lowest value or mean
  double second = 0;  ///< highest value or standard deviation
  /// Fixes what is drawn whatever the run's seed.
  std::optional<std::uint64_t> seed;

  static Distribution constant(double value) { return {Kind::constant, value, 0, {}}; }

  double sample(Random random) const;
  double sample(MengeRandom& random) const;
  /// A whole number; a uniform distribution includes both of its ends.
  int sample_integer(Random random) const;
  int sample_integer(MengeRandom& random) const;
};

/// A distribution of points: one point, or uniform over a rectangle.
struct Distribution2 {
  Eigen::Vector2f low = Eigen::Vector2f::Zero();
  Eigen::Vector2f high = Eigen::Vector2f::Zero();

  bool is_constant() const { return low == high; }
  Eigen::Vector2f sample(Random random) const;
  Eigen::Vector2f sample(MengeRandom& x, MengeRandom& y) const;
};

/// The random numbers of one element of the behaviour file. What an agent gets depends on how
/// often it has entered a state, so a decision holds until the agent enters another one.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  Random at(std::size_t agent, std::uint32_t entry) const;

 private:
  std::uint64_t seed_;
};

}  // namespace throng::crowd
