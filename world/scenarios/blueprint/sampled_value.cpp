#include "world/scenarios/blueprint/sampled_value.h"

#include <cmath>

namespace throng::scenarios {

using crowd::Attribute;
using crowd::describe::significant_text;
using world::JsonValue;

namespace {

constexpr const char* kExpected =
    "a number, or an object with one of \"uniform\", \"normal\" and \"lognormal\"";
constexpr double kMaxLogStddev = 3;

/// Normal values end, unless the blueprint says so, this number of standard deviations from
/// their mean.
constexpr double kDeviations = 3;

double to_three_digits(double value) { return std::stod(significant_text(value, 3)); }

/// The two numbers of a distribution.
bool read_pair(const JsonValue& value, const char* expected, const SampledLimits& limits,
               double max_second, SampledValue& sampled) {
  const std::vector<JsonValue> pair = value.tuple(2, expected);
  if (pair.size() != 2) return false;
  sampled.first = pair[0].number(limits.low, limits.high);
  sampled.second = pair[1].number(0, max_second);
  return true;
}

void read_uniform(const JsonValue& value, const SampledLimits& limits, SampledValue& sampled) {
  sampled.kind = SampledValue::Kind::uniform;
  if (!read_pair(value, "[lowest, highest]", limits, limits.high, sampled)) return;
  if (sampled.second < sampled.first) value.reject("two numbers, the lower one first");
}

void read_normal(const JsonValue& value, const SampledLimits& limits, SampledValue& sampled) {
  sampled.kind = SampledValue::Kind::normal;
  if (!read_pair(value, "[mean, standard deviation]", limits, limits.high, sampled)) return;
  const double farthest = kDeviations * sampled.second;
  if (sampled.first - farthest < limits.low) sampled.min = limits.low;
  if (sampled.first + farthest > limits.high) sampled.max = limits.high;
}

void read_lognormal(const JsonValue& value, const SampledLimits& limits, SampledValue& sampled) {
  sampled.kind = SampledValue::Kind::lognormal;
  if (!read_pair(value, "[median, standard deviation of the logarithm]", limits, kMaxLogStddev,
                 sampled)) {
    return;
  }
  if (sampled.first <= 0 || sampled.second <= 0) {
    value.reject("a median and a standard deviation above 0");
    return;
  }
  sampled.first = std::log(sampled.first);
  sampled.max = limits.high;
}

void read_limit(const JsonValue& value, const SampledLimits& limits, double& limit) {
  if (value.exists()) limit = value.number(limits.low, limits.high);
}

}  // namespace

std::vector<Attribute> SampledValue::attributes() const {
  const auto text = [](double value) { return significant_text(value, 6); };
  std::vector<Attribute> all;
  switch (kind) {
    case Kind::constant:
      return {{"dist", "c"}, {"value", text(first)}};
    case Kind::uniform:
      return {{"dist", "u"}, {"min", text(first)}, {"max", text(second)}};
    case Kind::normal:
      all = {{"dist", "n"}, {"mean", text(first)}, {"stddev", text(second)}};
      break;
    case Kind::lognormal:
      all = {{"dist", "lognormal"}, {"log_mean", text(first)}, {"log_stddev", text(second)}};
      break;
  }
  if (std::isfinite(min)) all.emplace_back("at_least", text(min));
  if (std::isfinite(max)) all.emplace_back("at_most", text(max));
  return all;
}

SampledValue read_sampled(const JsonValue& value, const SampledLimits& limits) {
  SampledValue sampled;
  const JsonValue uniform = value["uniform"];
  const JsonValue normal = value["normal"];
  const JsonValue lognormal = value["lognormal"];
  const int forms = static_cast<int>(uniform.exists()) + static_cast<int>(normal.exists()) +
                    static_cast<int>(lognormal.exists());
  if (forms == 0) {
    if (!value.is_number()) {
      value.reject(kExpected);
      return sampled;
    }
    sampled.first = value.number(limits.low, limits.high);
    if (limits.relative_stddev > 0) {
      sampled.kind = SampledValue::Kind::normal;
      sampled.second = to_three_digits(limits.relative_stddev * sampled.first);
    }
    return sampled;
  }
  if (uniform.exists()) {
    value.fields({"uniform"});
    read_uniform(uniform, limits, sampled);
    return sampled;
  }
  value.fields({normal.exists() ? "normal" : "lognormal"}, {"min", "max"});
  if (normal.exists()) {
    read_normal(normal, limits, sampled);
  } else {
    read_lognormal(lognormal, limits, sampled);
  }
  read_limit(value["min"], limits, sampled.min);
  read_limit(value["max"], limits, sampled.max);
  if (sampled.min >= sampled.max) value["max"].reject("a number above \"min\"");
  const double middle =
      sampled.kind == SampledValue::Kind::lognormal ? std::exp(sampled.first) : sampled.first;
  if (middle < sampled.min || middle > sampled.max) {
    value.reject("a mean or median outside of the limits", "one between \"min\" and \"max\"");
  }
  return sampled;
}

}  // namespace throng::scenarios
