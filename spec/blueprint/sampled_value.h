// A number of a blueprint that is sampled for each person: speeds and pre-movement times.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "base/json/field_table.h"
#include "crowd/description/builder.h"

namespace throng::scenarios {

/// A distribution of numbers.
struct SampledValue {
  enum class Kind { constant, uniform, normal, lognormal };

  Kind kind = Kind::constant;
  double first = 0;   ///< value, lowest value, mean, or mean of the natural logarithm
  double second = 0;  ///< highest value, standard deviation (of the logarithm)
  double min = -std::numeric_limits<double>::infinity();  ///< truncation of the distribution
  double max = std::numeric_limits<double>::infinity();   ///< truncation of the distribution

  static SampledValue normal(double mean, double stddev) { return {Kind::normal, mean, stddev}; }

  /// The distribution as attributes of an element of Menge's files.
  std::vector<crowd::Attribute> attributes() const;
};

/// Limits of the values in a blueprint.
struct SampledLimits {
  double low = 0;  ///< min of all values, which truncates a normal distribution
  double high = 0;
  /// If above 0, a plain number is the mean of a normal distribution whose standard deviation is
  /// this share of the mean; if 0, it is a constant.
  double relative_stddev = 0;
};

/// The rules of a number, {"uniform": [low, high]}, {"normal": [mean, standard deviation]} or
/// {"lognormal": [median, standard deviation of the logarithm]}; the latter two may have "min" and
/// "max".
fields::Values sampled_values(const SampledLimits& limits);

/// Reads a value that has a type of sampled_values(); adds problems.
SampledValue read_sampled(const nlohmann::json& value, const SampledLimits& limits,
                          const fields::FieldLocation& place);

}  // namespace throng::scenarios
