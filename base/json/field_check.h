// One field's rules, and checks of JSON values against them (base/json/field_table.h).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json/field_values.h"

namespace throng::fields {

/// Whether and how a field may be sampled for each run.
enum class Sampling : std::uint8_t {
  never,
  by_randomize,  ///< by the block "randomize" of the job (x-randomize)
  in_place,      ///< the field itself may hold a distribution (x-distribution)
};

/// The schema's rules of a field.
struct FieldRules {
  std::string path;  ///< below the object that the table describes: "sensor/iso"
  std::string title;
  std::string unit;  ///< or ""
  std::string help;
  Values values;
  Sampling sampling = Sampling::never;
  bool is_required = false;
  /// An object whose fields follow in the table with its path before theirs.
  bool is_group = false;
  nlohmann::ordered_json default_value;  ///< null: none
  /// The field's name of an earlier version, which is still read, with a warning; or "".
  std::string deprecated_name;
};

/// Path of the field's deprecated name: "sensor/old" for "sensor/new".
std::string deprecated_path(const FieldRules& field);

/// Source and pointer of a value that is read, for messages and for files that it names.
struct FieldLocation {
  std::string pointer;        ///< JSON pointer
  const std::string& source;  ///< the file, or "" for a request
  std::vector<Problem>& problems;

  FieldLocation below(const std::string& path) const {
    return {pointer + "/" + path, source, problems};
  }
  /// Warns that this is the deprecated name of a field; adds a problem and returns false if the
  /// field is also given by its name.
  bool allows_deprecated(const FieldRules& field, bool is_also_given) const;
};

/// Permitted values in words, from a schema's rules: "a number from 0 to 90".
std::string expectation(const nlohmann::json& rules);

/// Whether a value keeps the field's rules: type, words, range, length. Patterns are left to the
/// field's reader. If not, adds a problem.
bool check_value(const nlohmann::json& value, const FieldRules& field, const FieldLocation& place);

/// Whether a value is an object. Adds a problem if it is none, and for each unknown name (with the
/// nearest known one), missing required field and group that is no object.
bool check_object(const nlohmann::json& value, std::span<const FieldRules* const> fields,
                  const FieldLocation& place);

}  // namespace throng::fields
