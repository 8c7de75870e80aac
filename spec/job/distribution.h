// Values of a job that may be sampled for every run. A field holds one value, or
// {"choice": [a, b, ...]}, {"uniform": [low, high]}, {"log_uniform": [low, high]} (every octave is
// equally probable) or {"normal": [mean, standard deviation]} (values outside the field's range are
// sampled again).
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/json/field_table.h"

namespace throng::jobs {

using fields::Quantity;

/// The distribution of the values of one field.
class Distribution {
 public:
  enum class Kind : std::uint8_t { choice, uniform, log_uniform, normal };

  /// The distribution that always yields `value`.
  explicit Distribution(double value) : values_{value} {}

  /// Reads a field. Adds to `problems`, with `pointer` as the field's JSON pointer; the returned
  /// distribution is then meaningless.
  static Distribution read(const nlohmann::json& value, const Quantity& quantity,
                           const std::string& pointer, std::vector<Problem>& problems);

  /// The distribution as a job contains it; the inverse of read().
  nlohmann::json to_json(const Quantity& quantity) const;

  /// Whether the value may differ between runs.
  bool is_random() const { return kind_ != Kind::choice || values_.size() > 1; }

  /// Samples the field's value in a run. `pointer` is the field's JSON pointer, which makes the
  /// values of different fields independent.
  double draw(std::uint64_t run_seed, std::string_view pointer) const;

 private:
  void read_values(const nlohmann::json& list, const Quantity& quantity, const std::string& place,
                   std::vector<Problem>& problems);

  Kind kind_ = Kind::choice;
  std::vector<double> values_;  ///< choices; low and high; mean and standard deviation
  double low_ = 0;              ///< the field's range, which truncates a normal distribution
  double high_ = 0;
};

}  // namespace throng::jobs
