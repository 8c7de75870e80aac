#include "jobs/distribution.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/random.h"
#include "world/json_reader.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

/// FNV-1a (Fowler, Noll and Vo), 64 bits: a number for a field's name.
std::uint64_t number_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

}  // namespace

Quantity number_quantity(double low, double high) {
  return {fmt::format("a number from {} to {}", low, high),
          [low, high](const json& value) -> std::optional<double> {
            if (!value.is_number()) return std::nullopt;
            const auto number = value.get<double>();
            return number >= low && number <= high ? std::optional(number) : std::nullopt;
          },
          [](double number) { return json(number); }, true};
}

Distribution Distribution::read(const json& value, const Quantity& quantity,
                                const std::string& pointer, std::vector<Problem>& problems) {
  Distribution result(0);
  const auto reject = [&](const std::string& place, const json& found, std::string expected) {
    problems.push_back({"", place, world::describe(found), std::move(expected)});
  };
  const auto number_of_value = [&](const json& given, const std::string& place) {
    const std::optional<double> number = quantity.number(given);
    if (!number) reject(place, given, quantity.expected);
    return number.value_or(0);
  };
  if (!value.is_object()) {
    result.values_ = {number_of_value(value, pointer)};
    return result;
  }
  result.uniform_ = quantity.continuous && value.contains("uniform");
  const std::string key = result.uniform_ ? "uniform" : "choice";
  if (value.size() != 1 || !value.contains(key)) {
    reject(pointer, value,
           quantity.expected + R"(, {"choice": [...]})" +
               (quantity.continuous ? R"( or {"uniform": [low, high]})" : ""));
    return result;
  }
  const json& list = value[key];
  const std::string place = pointer + "/" + key;
  if (!list.is_array() || (result.uniform_ ? list.size() != 2 : list.empty())) {
    reject(place, list, result.uniform_ ? "[low, high]" : "a list of at least one value");
    return result;
  }
  result.values_.clear();
  for (std::size_t i = 0; i < list.size(); ++i) {
    result.values_.push_back(number_of_value(list[i], fmt::format("{}/{}", place, i)));
  }
  if (result.uniform_ && result.values_[0] > result.values_[1]) {
    reject(place + "/1", list[1], "a value not below the first");
  }
  return result;
}

json Distribution::to_json(const Quantity& quantity) const {
  if (values_.size() == 1 && !uniform_) return quantity.json(values_.front());
  json list = json::array();
  for (const double value : values_) list.push_back(quantity.json(value));
  return {{uniform_ ? "uniform" : "choice", std::move(list)}};
}

double Distribution::draw(std::uint64_t run_seed, std::string_view pointer) const {
  Random random(run_seed, Stream::randomize, number_of(pointer));
  if (uniform_) return random.uniform(values_[0], values_[1]);
  return values_[random.below(static_cast<std::uint32_t>(values_.size()))];
}

}  // namespace throng::jobs
