// Values of a job that may be drawn anew for every run: a field holds one value, or
// {"choice": [a, b, ...]}, or {"uniform": [low, high]}.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// How one field writes its values: as numbers, times, words.
struct Quantity {
  std::string expected;  ///< what a single value must be, for messages: "a number from 0 to 90"
  /// The value as a number; nothing when it is not one of the field's.
  std::function<std::optional<double>(const nlohmann::json&)> number;
  /// The reverse.
  std::function<nlohmann::json(double)> json;
  bool continuous = true;  ///< whether "uniform" makes sense
};

/// Numbers from `low` to `high`.
Quantity number_quantity(double low, double high);

class Distribution {
 public:
  /// Always this value.
  explicit Distribution(double value) : values_{value} {}

  /// Reads a field. Problems (with `pointer` as the field's place) are added to `problems`; what
  /// is returned then is of no use.
  static Distribution read(const nlohmann::json& value, const Quantity& quantity,
                           const std::string& pointer, std::vector<Problem>& problems);

  /// As it is written in a job; read() reads it back.
  nlohmann::json to_json(const Quantity& quantity) const;

  /// The value that this field has in a run. `pointer` names the field, so that fields do not
  /// depend on each other.
  double draw(std::uint64_t run_seed, std::string_view pointer) const;

 private:
  std::vector<double> values_;  ///< to choose from, or low and high
  bool uniform_ = false;
};

}  // namespace throng::jobs
