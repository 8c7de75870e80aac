// A number of a blueprint that is sampled for each person: speeds and pre-movement times.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "crowd/description/builder.h"
#include "world/json_reader.h"

namespace throng::scenarios {

/// A distribution of numbers.
struct SampledValue {
  enum class Kind { constant, uniform, normal, lognormal };

  Kind kind = Kind::constant;
  double first = 0;   ///< value, lowest value, mean, or mean of the natural logarithm
  double second = 0;  ///< highest value, standard deviation (of the logarithm)
  double min = -std::numeric_limits<double>::infinity();  ///< lower values are not sampled
  double max = std::numeric_limits<double>::infinity();   ///< higher values are not sampled

  static SampledValue normal(double mean, double stddev) { return {Kind::normal, mean, stddev}; }

  /// As attributes of an element of Menge's files.
  std::vector<crowd::Attribute> attributes() const;
};

/// Values that a blueprint may give.
struct SampledLimits {
  double low = 0;  ///< of all values; a normal distribution is cut off there
  double high = 0;
  /// A plain number is the mean of a normal distribution whose standard deviation is this share of
  /// it; 0: it is the value of everybody.
  double relative_stddev = 0;
};

/// Reads a number, {"uniform": [low, high]}, {"normal": [mean, standard deviation]} or
/// {"lognormal": [median, standard deviation of the logarithm]}; the latter two with "min" and
/// "max".
SampledValue read_sampled(const world::JsonValue& value, const SampledLimits& limits);

}  // namespace throng::scenarios
