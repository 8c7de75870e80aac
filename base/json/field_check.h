// Rules of a field, and checks of JSON values against them (base/json/field_table.h).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/json/field_values.h"

namespace throng::fields {

/// Whether and how jobs may sample a field for each run.
enum class Sampling : std::uint8_t {
  never,
  by_randomize,  ///< with the block "randomize" of the job (x-randomize)
  in_place,      ///< with a distribution as the field's value (x-distribution)
};

/// The rules of a field in the schema.
struct FieldRules {
  std::string path;  ///< relative to the object of the table, e.g. "sensor/iso"
  std::string title;
  std::string unit;  ///< may be empty
  std::string help;
  Values values;
  Sampling sampling = Sampling::never;
  bool is_required = false;
  /// Whether the field is an object whose fields follow in the table, with its path as prefix.
  bool is_group = false;
  nlohmann::ordered_json default_value;  ///< null if there is no default
  /// Name in an earlier version, which is accepted with a warning; may be empty.
  std::string deprecated_name;
};

/// Returns the path of the field's deprecated name: "sensor/old" for "sensor/new".
std::string deprecated_path(const FieldRules& field);

/// Position of a value in a document, and the list for its problems.
struct FieldLocation {
  std::string pointer;        ///< JSON pointer
  const std::string& source;  ///< name of the file; "" for a request
  std::vector<Problem>& problems;

  FieldLocation below(const std::string& path) const {
    return {pointer + "/" + path, source, problems};
  }
  FieldLocation below(std::size_t index) const { return below(std::to_string(index)); }
  /// Adds a problem with the value at this position.
  void reject(std::string found, std::string expected) const;
  /// Returns whether there is a problem with the value at `path`, or with that at this position, or
  /// below it: rules that span several fields hold only for valid ones.
  bool has_problem(std::string_view path = "") const;
  /// Warns that the document uses the deprecated name of a field. If it also has the new name, adds
  /// a problem instead and returns false.
  bool allows_deprecated(const FieldRules& field, bool is_also_given) const;
};

/// Describes the permitted values of a schema, e.g. "a number from 0 to 90".
std::string expectation(const nlohmann::json& rules);

/// Checks a value, and the elements of a list, against the type, words, range, length and
/// has_pattern() of permitted values; adds problems and returns false if it breaks them. Other
/// patterns, and elements with fields of their own, are checked by a field's setter.
bool check_value(const nlohmann::json& value, const Values& values, const FieldLocation& place);

/// Returns whether a value is an object; adds a problem if not, and problems for unknown names
/// (with a suggestion), missing required fields and groups that are not objects.
bool check_object(const nlohmann::json& value, std::span<const FieldRules* const> fields,
                  const FieldLocation& place);

}  // namespace throng::fields
