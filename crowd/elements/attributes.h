// The attributes of an element, described by a table: the table is what is checked, what supplies
// the defaults, and what a list of the vocabulary prints.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "crowd/elements/distribution.h"
#include "crowd/elements/element.h"

namespace throng::crowd {

/// Coordinates beyond this (in meters) are mistakes, and floats grow coarse there.
constexpr double kMaxCoordinate = 1e5;
/// The greatest id of a goal, a goal set or an agent.
constexpr double kMaxId = 1e9;

enum class AttributeType {
  number,
  integer,
  boolean,        ///< false or true or an integer, of which 0 is false
  text,           ///< not empty
  distribution,   ///< a group: <name>dist, <name>min, ...; the attribute's name is the prefix
  distribution_2  ///< a group: dist, x_value, y_value, min_x, ...
};

enum class Presence { required, optional };

struct AttributeSpec {
  std::string_view name;
  AttributeType type = AttributeType::number;
  std::string_view help;
  Presence presence = Presence::required;
  /// Value of an optional attribute that is absent; "" means that the reader asks has().
  std::string_view default_text = {};
  double min = -kMaxCoordinate;
  double max = kMaxCoordinate;
  /// For text: the words allowed; empty allows any.
  std::vector<std::string_view> words = {};
  /// Name of an earlier version, which is still read, with a warning; or "". Not of distributions.
  std::string_view deprecated_name = {};
};

/// Shorthands for tables.
AttributeSpec number(std::string_view name, std::string_view help, double min = -kMaxCoordinate,
                     double max = kMaxCoordinate);
AttributeSpec integer(std::string_view name, std::string_view help, double min, double max);
AttributeSpec boolean(std::string_view name, std::string_view help);
AttributeSpec text(std::string_view name, std::string_view help);
AttributeSpec word(std::string_view name, std::vector<std::string_view> words,
                   std::string_view help);
AttributeSpec distribution(std::string_view prefix, std::string_view help,
                           double min = -kMaxCoordinate, double max = kMaxCoordinate);
AttributeSpec distribution_2(std::string_view help);
/// The same attribute, optional. Without a default the reader has to ask has().
AttributeSpec optional(AttributeSpec spec, std::string_view default_text = "");
/// The same attribute, which had another name in an earlier version.
AttributeSpec renamed(AttributeSpec spec, std::string_view deprecated_name);

using AttributeTable = std::vector<AttributeSpec>;

/// The checked values of an element's attributes. Throws InputError for an attribute that is
/// missing, malformed or out of range; one that is not in the table is ignored with a warning.
/// Asking for one that is not in the table is a bug.
class Attributes {
 public:
  Attributes(const Element& element, const AttributeTable& table);

  bool has(std::string_view name) const;  ///< given, or has a default
  double number(std::string_view name) const;
  float real(std::string_view name) const { return static_cast<float>(number(name)); }
  long long integer(std::string_view name) const;
  bool boolean(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  const Distribution& distribution(std::string_view prefix) const;
  const Distribution2& distribution_2() const;

 private:
  using Value = std::variant<std::monostate, double, long long, bool, std::string, Distribution,
                             Distribution2>;

  const Value& value(std::string_view name) const;

  std::vector<std::pair<std::string_view, Value>> values_;
};

}  // namespace throng::crowd
