// Fields of a trajectory file's format that jobs and experiments share.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/json/field_table.h"
#include "spec/metrics/trajectory_format.h"

namespace throng::metrics {

/// Adds the frame rate and the unit of lengths. `format` returns an object's TrajectoryFormat.
template <typename Object, typename Access>
void add_rate_and_unit(fields::FieldTable<Object>& table, Access format) {
  using nlohmann::json;
  table.add(
      "frame_rate_hz", "Frame rate", "Hz", fields::numbers(0.01, 10'000),
      [format](auto& object) -> auto& { return format(object).frames_per_s; },
      "Frames per second, if the file does not contain the rate or is wrong; with a column of "
      "times, the rate to interpolate to.");
  std::vector<std::string> words;
  words.reserve(std::size(kLengthUnits));
  for (const LengthUnit& unit : kLengthUnits) words.emplace_back(unit.word);
  table.add(
      "unit", "Unit", "", fields::one_of_words(words),
      [format](const Object& object) {
        for (const LengthUnit& unit : kLengthUnits) {
          if (format(object).unit_m == unit.meters) return json(unit.word);
        }
        return json();
      },
      [format](Object& object, const json& value, const fields::FieldLocation& /*place*/) {
        for (const LengthUnit& unit : kLengthUnits) {
          if (value == unit.word) format(object).unit_m = unit.meters;
        }
      },
      "Unit of lengths in the file; default: the file's, else m.");
}

}  // namespace throng::metrics
