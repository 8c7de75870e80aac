#include "spec/job/distribution.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/compute/random.h"
#include "base/json/json_describe.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

/// FNV-1a (Fowler, Noll and Vo), 64 bits: a number for a field's name.
std::uint64_t hash_name(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

constexpr std::array<std::string_view, 4> kKinds = {"choice", "uniform", "log_uniform", "normal"};

std::string forms(const Quantity& quantity) {
  return quantity.expected + R"(, {"choice": [...]})" +
         (quantity.continuous ? R"(, {"uniform": [low, high]}, {"log_uniform": [low, high]} or )"
                                R"({"normal": [mean, standard deviation]})"
                              : "");
}

/// A standard deviation, in the field's unit.
std::optional<double> standard_deviation(const json& value, const Quantity& quantity) {
  const std::optional<double> given =
      value.is_number() ? std::optional(value.get<double>()) : quantity.number(value);
  return given && *given > 0 && std::isfinite(*given) ? given : std::nullopt;
}

}  // namespace

Distribution Distribution::read(const json& value, const Quantity& quantity,
                                const std::string& pointer, std::vector<Problem>& problems) {
  Distribution result(0);
  result.low_ = quantity.low;
  result.high_ = quantity.high;
  if (!value.is_object()) {
    result.read_values(json::array({value}), quantity, pointer, problems);
    return result;
  }
  std::size_t kind = 0;
  const std::size_t kinds = quantity.continuous ? kKinds.size() : 1;
  while (kind < kinds && !value.contains(kKinds.at(kind))) ++kind;
  if (value.size() != 1 || kind == kinds) {
    problems.push_back({"", pointer, describe(value), forms(quantity)});
    return result;
  }
  result.kind_ = static_cast<Kind>(kind);
  const std::string key(kKinds.at(kind));
  const json& list = value[key];
  const std::string place = pointer + "/" + key;
  const bool choice = result.kind_ == Kind::choice;
  if (!list.is_array() || (choice ? list.empty() : list.size() != 2)) {
    const char* pair = result.kind_ == Kind::normal ? "[mean, standard deviation]" : "[low, high]";
    problems.push_back({"", place, describe(list), choice ? "a list of at least one value" : pair});
    return result;
  }
  result.read_values(list, quantity, place, problems);
  return result;
}

void Distribution::read_values(const json& list, const Quantity& quantity, const std::string& place,
                               std::vector<Problem>& problems) {
  values_.clear();
  const std::size_t before = problems.size();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool deviation = kind_ == Kind::normal && i == 1;
    const std::optional<double> number =
        deviation ? standard_deviation(list[i], quantity) : quantity.number(list[i]);
    if (!number) {
      const bool alone = kind_ == Kind::choice && !place.ends_with("/choice");
      problems.push_back({"", alone ? place : fmt::format("{}/{}", place, i), describe(list[i]),
                          deviation ? "a standard deviation above 0" : quantity.expected});
    }
    values_.push_back(number.value_or(deviation ? 1 : 0));
  }
  if (problems.size() > before || kind_ == Kind::choice || kind_ == Kind::normal) return;
  if (values_[0] > values_[1]) {
    problems.push_back({"", place + "/1", describe(list[1]), "a value not below the first"});
  } else if (kind_ == Kind::log_uniform && !(values_[0] > 0)) {
    problems.push_back({"", place + "/0", describe(list[0]), "a value above 0"});
  }
}

json Distribution::to_json(const Quantity& quantity) const {
  if (!is_random()) return quantity.json(values_.front());
  json list = json::array();
  for (const double value : values_) list.push_back(quantity.json(value));
  // A deviation may be finer than the field's own values.
  if (kind_ == Kind::normal && list[0].is_number()) list[1] = values_[1];
  return {{std::string(kKinds.at(static_cast<std::size_t>(kind_))), std::move(list)}};
}

double Distribution::draw(std::uint64_t run_seed, std::string_view pointer) const {
  Random random(run_seed, Stream::randomize, hash_name(pointer));
  switch (kind_) {
    case Kind::uniform:
      return random.uniform(values_[0], values_[1]);
    case Kind::log_uniform:
      return std::exp(random.uniform(std::log(values_[0]), std::log(values_[1])));
    case Kind::normal: {
      constexpr int kMaxTries = 1000;
      for (int i = 0; i < kMaxTries; ++i) {
        const double value = random.normal(values_[0], values_[1]);
        if (value >= low_ && value <= high_) return value;
      }
      return values_[0];
    }
    case Kind::choice:
      break;
  }
  return values_[random.below(static_cast<std::uint32_t>(values_.size()))];
}

}  // namespace throng::jobs
