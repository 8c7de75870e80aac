#include "spec/blueprint/sampled_value.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "base/json/json_describe.h"

namespace throng::scenarios {

using crowd::Attribute;
using crowd::describe::significant_text;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr const char* kExpected =
    "a number, or an object with one of \"uniform\", \"normal\" and \"lognormal\"";
constexpr double kMaxLogStddev = 3;

/// Normal values end, unless the blueprint says so, this number of standard deviations from
/// their mean.
constexpr double kDeviations = 3;

double to_three_digits(double value) { return std::stod(significant_text(value, 3)); }

/// The two numbers of a distribution.
bool read_pair(const json& pair, const SampledLimits& limits, double max_second,
               const FieldLocation& place, SampledValue& sampled) {
  const fields::Values first = fields::numbers(limits.low, limits.high);
  const bool is_first_valid = fields::check_value(pair[0], first, place.below(0));
  const fields::Values second = fields::numbers(0, max_second);
  if (!fields::check_value(pair[1], second, place.below(1)) || !is_first_valid) return false;
  sampled.first = pair[0].get<double>();
  sampled.second = pair[1].get<double>();
  return true;
}

fields::Values pairs(const char* expected) {
  fields::Values values = fields::lists(2, 2, {{"type", "number"}});
  values.expected = expected;
  return values;
}

FieldTable<SampledValue> uniform_fields(const SampledLimits& limits) {
  FieldTable<SampledValue> table;
  table
      .add_read(
          "uniform", pairs("[lowest, highest]"),
          [limits](SampledValue& sampled, const json& pair, const FieldLocation& place) {
            sampled.kind = SampledValue::Kind::uniform;
            if (read_pair(pair, limits, limits.high, place, sampled) &&
                sampled.second < sampled.first) {
              place.reject(describe(pair), "two numbers, the lower one first");
            }
          },
          "[lowest, highest]: every value between them is equally likely.")
      .required();
  return table;
}

void add_limits(FieldTable<SampledValue>& table, const SampledLimits& limits) {
  const fields::Values numbers = fields::numbers(limits.low, limits.high);
  table.add("min", "", "", numbers, fields::at(&SampledValue::min), "Lower values are not sampled.")
      .without_default();
  table
      .add("max", "", "", numbers, fields::at(&SampledValue::max), "Higher values are not sampled.")
      .without_default();
}

FieldTable<SampledValue> normal_fields(const SampledLimits& limits) {
  FieldTable<SampledValue> table;
  table
      .add_read(
          "normal", pairs("[mean, standard deviation]"),
          [limits](SampledValue& sampled, const json& pair, const FieldLocation& place) {
            sampled.kind = SampledValue::Kind::normal;
            if (!read_pair(pair, limits, limits.high, place, sampled)) return;
            const double farthest = kDeviations * sampled.second;
            if (sampled.first - farthest < limits.low) sampled.min = limits.low;
            if (sampled.first + farthest > limits.high) sampled.max = limits.high;
          },
          "[mean, standard deviation] of a normal distribution, cut at three standard deviations.")
      .required();
  add_limits(table, limits);
  return table;
}

FieldTable<SampledValue> lognormal_fields(const SampledLimits& limits) {
  FieldTable<SampledValue> table;
  table
      .add_read(
          "lognormal", pairs("[median, standard deviation of the logarithm]"),
          [limits](SampledValue& sampled, const json& pair, const FieldLocation& place) {
            sampled.kind = SampledValue::Kind::lognormal;
            if (!read_pair(pair, limits, kMaxLogStddev, place, sampled)) return;
            if (sampled.first <= 0 || sampled.second <= 0) {
              place.reject(describe(pair), "a median and a standard deviation above 0");
              return;
            }
            sampled.first = std::log(sampled.first);
            sampled.max = limits.high;
          },
          "[median, standard deviation of the logarithm] of a lognormal distribution.")
      .required();
  add_limits(table, limits);
  return table;
}

/// The fields of the distribution that an object has.
FieldTable<SampledValue> fields_for(const json& value, const SampledLimits& limits) {
  if (value.contains("uniform")) return uniform_fields(limits);
  return value.contains("normal") ? normal_fields(limits) : lognormal_fields(limits);
}

/// A plain number.
SampledValue read_number(const json& value, const SampledLimits& limits,
                         const FieldLocation& place) {
  SampledValue sampled;
  if (!fields::check_value(value, fields::numbers(limits.low, limits.high), place)) return sampled;
  sampled.first = value.get<double>();
  if (limits.relative_stddev > 0) {
    sampled.kind = SampledValue::Kind::normal;
    sampled.second = to_three_digits(limits.relative_stddev * sampled.first);
  }
  return sampled;
}

/// Adds a problem if the limits of a distribution leave nothing, or not its middle.
void check_limits(const SampledValue& sampled, const json& value, const FieldLocation& place) {
  if (sampled.min >= sampled.max && value.contains("max")) {
    place.below("max").reject(describe(value["max"]), "a number above \"min\"");
  }
  const double middle =
      sampled.kind == SampledValue::Kind::lognormal ? std::exp(sampled.first) : sampled.first;
  if (middle < sampled.min || middle > sampled.max) {
    place.reject("a mean or median outside of the limits", "one between \"min\" and \"max\"");
  }
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

fields::Values sampled_values(const SampledLimits& limits) {
  ordered_json forms = ordered_json::array(
      {fields::numbers(limits.low, limits.high).rules,
       fields::form("A uniform distribution.", uniform_fields(limits).schema()),
       fields::form("A normal distribution.", normal_fields(limits).schema()),
       fields::form("A lognormal distribution.", lognormal_fields(limits).schema())});
  return {{{"type", {"number", "object"}}, {"anyOf", std::move(forms)}}, kExpected};
}

SampledValue read_sampled(const json& value, const SampledLimits& limits,
                          const FieldLocation& place) {
  if (value.is_number()) return read_number(value, limits, place);
  SampledValue sampled;
  if (!value.contains("uniform") && !value.contains("normal") && !value.contains("lognormal")) {
    place.reject(describe(value), kExpected);
    return sampled;
  }
  const std::size_t problems = place.problems.size();
  fields_for(value, limits).read_checked(value, sampled, place);
  const bool is_valid = place.problems.size() == problems;
  if (is_valid && sampled.kind != SampledValue::Kind::uniform) check_limits(sampled, value, place);
  return sampled;
}

}  // namespace throng::scenarios
