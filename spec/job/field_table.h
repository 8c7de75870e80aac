// Tables of a job's fields (base/json/field_table.h), some of which may be distributions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/json/field_table.h"
#include "spec/job/distribution.h"

namespace throng::jobs {

using fields::at;
using fields::booleans;
using fields::Field;
using fields::FieldLocation;
using fields::FieldRules;
using fields::FieldTable;
using fields::identifiers;
using fields::integers;
using fields::lists;
using fields::number_quantity;
using fields::numbers;
using fields::numbers_above;
using fields::object_with;
using fields::one_of_words;
using fields::plain_numbers;
using fields::pointer_below;
using fields::raw;
using fields::Sampling;
using fields::schema_text;
using fields::set_value;
using fields::texts;
using fields::texts_like;
using fields::value_at;
using fields::value_json;
using fields::Values;

/// A list of `count` coordinates in m; `is_random`: the block "randomize" may name each of them.
Values coordinates(int count, bool is_random = false);

/// One of these words, or a choice of them for each run.
Values sampled_words(std::span<const std::string> words);
template <typename Words>
Values sampled_words(const Words& words) {
  const std::vector<std::string> texts(words.begin(), words.end());
  return sampled_words(std::span<const std::string>(texts));
}

/// A sampled field as a job contains it; null if there is no distribution.
nlohmann::json sampled_json(const Distribution& distribution, const Quantity& quantity);
nlohmann::json sampled_json(const std::optional<Distribution>& distribution,
                            const Quantity& quantity);

/// Adds a field that may hold a distribution. `access` returns a reference to the Distribution, or
/// to the optional Distribution, in an object.
template <typename Object, typename Access>
Field<Object>& add_sampled(FieldTable<Object>& table, std::string path, std::string title,
                           std::string unit, Values values, Access access, std::string help) {
  Quantity quantity = *values.quantity;
  Field<Object>& field = table.add(
      std::move(path), std::move(title), std::move(unit), std::move(values),
      [access, quantity](const Object& object) { return sampled_json(access(object), quantity); },
      [access, quantity](Object& object, const nlohmann::json& value, const FieldLocation& place) {
        access(object) = Distribution::read(value, quantity, place.pointer, place.problems);
      },
      std::move(help));
  field.sampling = Sampling::in_place;
  return field;
}

}  // namespace throng::jobs
