// Random values as the XML writes them: dist="c" value, dist="u" min max, dist="n" mean stddev, and
// those that times before moving and walking speeds have in studies of evacuation.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "base/compute/random.h"
#include "crowd/elements/menge_random.h"

namespace throng::crowd {

/// A distribution of numbers. Normal values are moved to within three standard deviations, unless
/// limits are given: then, as with the kinds that follow, only values between those are sampled.
struct Distribution {
  enum class Kind { constant, uniform, normal, lognormal, weibull, gamma, exponential };

  Kind kind = Kind::constant;
  double first = 0;   ///< value, lowest value, mean (of the logarithm) or shape
  double second = 0;  ///< highest value, standard deviation (of the logarithm) or scale
  /// Fixes the samples regardless of the run's seed.
  std::optional<std::uint64_t> seed;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();

  static Distribution constant(double value) { return {Kind::constant, value, 0, {}}; }

  /// The share of values between the limits among those of the distribution without them.
  double share_between_limits() const;

  double sample(Random random) const;
  double sample(MengeRandom& random) const;
  /// A whole number; a uniform distribution includes both of its ends.
  int sample_integer(Random random) const;
  int sample_integer(MengeRandom& random) const;

 private:
  bool is_by_quantile() const;
  double quantile_between_limits(double unit) const;
};

/// How the files write a kind of distribution.
struct DistributionForm {
  struct Parameter {
    std::string_view name;
    /// Its limits: those of the property, or these.
    bool is_a_value = true;
    double min = 0;
    double max = 0;
    std::string_view help;
  };

  std::string_view word;  ///< the attribute `dist`
  Distribution::Kind kind;
  std::string_view help;
  std::span<const Parameter> parameters;  ///< Distribution::first and, if there are two, ::second
  bool has_limits = false;                ///< takes at_least and at_most
};

/// By Distribution::Kind.
std::span<const DistributionForm> distribution_forms();

/// A distribution of points: one point, or uniform over a rectangle.
struct Distribution2 {
  Eigen::Vector2f low = Eigen::Vector2f::Zero();
  Eigen::Vector2f high = Eigen::Vector2f::Zero();

  bool is_constant() const { return low == high; }
  Eigen::Vector2f sample(Random random) const;
  Eigen::Vector2f sample(MengeRandom& x, MengeRandom& y) const;
};

/// The random numbers of one element of the behavior file. An agent's values depend on how
/// often it has entered a state, so a decision holds until the agent enters another one.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  Random at(std::size_t agent, std::uint32_t entry) const;

 private:
  std::uint64_t seed_;
};

}  // namespace throng::crowd
