// Distributions of random values, as files write them: dist="c" value, dist="u" min max, dist="n"
// mean stddev, and those of pre-movement times and walking speeds in evacuation studies.
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

/// A distribution of numbers. Normal values beyond three standard deviations are set to the nearest
/// permitted value. With limits, a normal distribution is truncated to them and to three standard
/// deviations instead, and the kinds that follow it are truncated to the limits.
struct Distribution {
  enum class Kind { constant, uniform, normal, lognormal, weibull, gamma, exponential };

  Kind kind = Kind::constant;
  double first = 0;   ///< value, min, mean (of the logarithm) or shape
  double second = 0;  ///< max, standard deviation (of the logarithm) or scale
  /// If set, samples do not depend on the seed of the run.
  std::optional<std::uint64_t> seed;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();

  static Distribution constant(double value) { return {Kind::constant, value, 0, {}}; }

  /// Probability of values between the limits in the distribution without limits.
  double share_between_limits() const;

  double sample(Random random) const;
  double sample(MengeRandom& random) const;
  /// Samples an integer; a uniform distribution includes both ends.
  int sample_integer(Random random) const;
  int sample_integer(MengeRandom& random) const;

 private:
  bool is_by_quantile() const;
  double quantile_between_limits(double unit) const;
};

/// The notation of a kind of distribution in files.
struct DistributionForm {
  struct Parameter {
    std::string_view name;
    /// Whether the limits of the property apply; otherwise `min` and `max` do.
    bool is_a_value = true;
    double min = 0;
    double max = 0;
    std::string_view help;
  };

  std::string_view word;  ///< value of the attribute `dist`
  Distribution::Kind kind;
  std::string_view help;
  /// Meaning of Distribution::first and, if there are two, Distribution::second.
  std::span<const Parameter> parameters;
  bool has_limits = false;  ///< whether at_least and at_most are permitted
};

/// Indexed by Distribution::Kind.
std::span<const DistributionForm> distribution_forms();

/// A distribution of points: constant, or uniform over a rectangle.
struct Distribution2 {
  Eigen::Vector2f low = Eigen::Vector2f::Zero();
  Eigen::Vector2f high = Eigen::Vector2f::Zero();

  bool is_constant() const { return low == high; }
  Eigen::Vector2f sample(Random random) const;
  Eigen::Vector2f sample(MengeRandom& x, MengeRandom& y) const;
};

/// Random numbers of one element of a file. The numbers of an agent depend on how many states it
/// has entered, so a decision does not change until the agent enters another state.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  Random at(std::size_t agent, std::uint32_t entry) const;

 private:
  std::uint64_t seed_;
};

}  // namespace throng::crowd
