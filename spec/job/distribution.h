// Values of a job that may be sampled again for every run: a field holds one value, or
// {"choice": [a, b, ...]}, {"uniform": [low, high]}, {"log_uniform": [low, high]} (equally many in
// every octave) or {"normal": [mean, standard deviation]}, whose values outside the field's range
// are sampled again.
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

class Distribution {
 public:
  enum class Kind : std::uint8_t { choice, uniform, log_uniform, normal };

  /// Always this value.
  explicit Distribution(double value) : values_{value} {}

  /// Reads a field. Problems (with `pointer` as the field's place) are added to `problems`; what
  /// is returned then is of no use.
  static Distribution read(const nlohmann::json& value, const Quantity& quantity,
                           const std::string& pointer, std::vector<Problem>& problems);

  /// As it is written in a job; read() reads it back.
  nlohmann::json to_json(const Quantity& quantity) const;

  /// Whether runs may differ.
  bool is_random() const { return kind_ != Kind::choice || values_.size() > 1; }

  /// The value that this field has in a run. `pointer` names the field, so that fields do not
  /// depend on each other.
  double draw(std::uint64_t run_seed, std::string_view pointer) const;

 private:
  void read_values(const nlohmann::json& list, const Quantity& quantity, const std::string& place,
                   std::vector<Problem>& problems);

  Kind kind_ = Kind::choice;
  std::vector<double> values_;  ///< to choose from; low and high; mean and standard deviation
  double low_ = 0;              ///< of the field's range: a normal distribution ends there
  double high_ = 0;
};

}  // namespace throng::jobs
