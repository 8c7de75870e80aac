// Tables of the attributes of elements. A table defines the checks, the defaults, and the list of
// the vocabulary.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "crowd/elements/distribution.h"
#include "crowd/elements/element.h"

namespace throng::crowd {

/// Max absolute value of coordinates (m); greater values are mistakes, and floats are imprecise
/// there.
constexpr double kMaxCoordinate = 1e5;
/// Max id of a goal, a goal set or an agent.
constexpr double kMaxId = 1e9;

enum class AttributeType {
  number,
  integer,
  boolean,        ///< true or false, or an integer: 0 is false
  text,           ///< not empty
  distribution,   ///< a group: <name>dist, <name>min, ...; the attribute's name is the prefix
  distribution_2  ///< a group: dist, x_value, y_value, min_x, ...
};

enum class Presence { required, optional };

/// Definition of an attribute.
struct AttributeSpec {
  std::string_view name;
  AttributeType type = AttributeType::number;
  std::string_view help;
  Presence presence = Presence::required;
  /// Value of an absent optional attribute; "": there is no default, and the reader calls has().
  std::string_view default_text = {};
  double min = -kMaxCoordinate;
  double max = kMaxCoordinate;
  /// Permitted words of a text; empty: any text.
  std::vector<std::string_view> words = {};
  /// Name in an earlier version, accepted with a warning; may be empty. Not for distributions.
  std::string_view deprecated_name = {};
};

/// Functions that create rows of tables.
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
/// Makes an attribute optional. Without a default, the reader must call has().
AttributeSpec optional(AttributeSpec spec, std::string_view default_text = "");
/// Declares that an attribute had another name in an earlier version.
AttributeSpec renamed(AttributeSpec spec, std::string_view deprecated_name);

using AttributeTable = std::vector<AttributeSpec>;

/// The checked values of an element's attributes. The constructor throws InputError for missing,
/// malformed and out-of-range attributes; attributes that are not in the table are ignored with a
/// warning. Access to an attribute that is not in the table aborts the program (see check()).
class Attributes {
 public:
  Attributes(const Element& element, const AttributeTable& table);

  bool has(std::string_view name) const;  ///< whether it is given or has a default
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
