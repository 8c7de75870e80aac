// Tables of the fields of JSON objects. A row defines a field: path, title, help, unit, permitted
// values, whether runs of a job may sample it, and the member in which the program stores it.
// Reading, checking, printing, schemas and tables of the documentation are derived from it.
// Defaults are those of the structs.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json/field_check.h"
#include "base/json/field_schema.h"
#include "base/json/field_values.h"

namespace throng::fields {

// clang-tidy does not see that templates move their parameters.
// NOLINTBEGIN(performance-unnecessary-value-param)

/// A row of a table.
template <typename Object>
struct Field : FieldRules {
  /// Returns the value as jobs write it; null: the field is omitted.
  std::function<nlohmann::json(const Object&)> get;
  /// Stores a value that the schema permits.
  std::function<void(Object&, const nlohmann::json& value, const FieldLocation&)> set;

  /// Allows sampling by the block "randomize" of a job.
  Field& randomized() {
    sampling = Sampling::by_randomize;
    return *this;
  }
  Field& required() {
    is_required = true;
    default_value = nullptr;
    return *this;
  }
  /// Sets the default in the schema for a field that printed jobs omit.
  Field& with_default(nlohmann::ordered_json value) {
    default_value = std::move(value);
    return *this;
  }
  /// Declares that the field was called `name` in an earlier version. Not for fields that may be
  /// sampled.
  Field& renamed_from(std::string name) {
    deprecated_name = std::move(name);
    return *this;
  }
  Field& titled(std::string name) {
    title = std::move(name);
    return *this;
  }
  Field& measured_in(std::string name) {
    unit = std::move(name);
    return *this;
  }
  /// Sets the text of permitted values for messages.
  Field& expecting(std::string text) {
    values.expected = std::move(text);
    return *this;
  }
  /// Adds a check of what was read: check(object, value, location).
  template <typename Check>
  Field& checked(Check check) {
    set = [read = std::move(set), check](Object& object, const nlohmann::json& value,
                                         const FieldLocation& place) {
      read(object, value, place);
      check(object, value, place);
    };
    return *this;
  }
  /// Marks an object without default; the help text says what happens if it is missing.
  Field& without_default() {
    default_value = nullptr;
    return *this;
  }
};

/// Returns a function that accesses a nested member: at(&JobSpec::capture, &CaptureSpec::rate_hz).
template <typename... Members>
constexpr auto at(Members... members) {
  return [members...](auto& object) -> auto& { return (object.*....*members); };
}

/// Converts a value to JSON as jobs have it; empty texts and optionals become null.
template <typename Value>
nlohmann::json value_json(const Value& value) {
  return value;
}
inline nlohmann::json value_json(const std::string& value) {
  return value.empty() ? nlohmann::json() : nlohmann::json(value);
}
/// Vectors of Eigen.
template <typename Vector>
requires(Vector::SizeAtCompileTime > 0) nlohmann::json value_json(const Vector& value) {
  nlohmann::json list = nlohmann::json::array();
  for (int i = 0; i < Vector::SizeAtCompileTime; ++i) list.push_back(value[i]);
  return list;
}
template <typename Value>
nlohmann::json value_json(const std::optional<Value>& value) {
  return value ? value_json(*value) : nlohmann::json();
}
/// Reads a checked JSON value.
template <typename Value>
void set_value(const nlohmann::json& given, Value& value) {
  given.get_to(value);
}
template <typename Vector>
requires(Vector::SizeAtCompileTime > 0) void set_value(const nlohmann::json& given, Vector& value) {
  for (int i = 0; i < Vector::SizeAtCompileTime; ++i) {
    value[i] = given.at(static_cast<std::size_t>(i)).get<double>();
  }
}
template <typename Value>
void set_value(const nlohmann::json& given, std::optional<Value>& value) {
  set_value(given, value.emplace());
}

/// The fields of one type of object, in the order of the schema.
template <typename Object>
class FieldTable {
 public:
  using Fields = std::vector<Field<Object>>;
  using Get = std::function<nlohmann::json(const Object&)>;
  using Set = std::function<void(Object&, const nlohmann::json&, const FieldLocation&)>;

  /// Adds an object whose fields follow; if it is missing, its fields have their defaults.
  Field<Object>& group(std::string path, std::string title, std::string help) {
    Field<Object>& field = fields_.emplace_back();
    field.path = std::move(path);
    field.title = std::move(title);
    field.help = std::move(help);
    field.is_group = true;
    field.default_value = nlohmann::ordered_json::object();
    return field;
  }

  /// Adds a field that is stored in the member that `access` returns (see at()).
  template <typename Access>
  Field<Object>& add(std::string path, std::string title, std::string unit, Values values,
                     Access access, std::string help) {
    return add(
        std::move(path), std::move(title), std::move(unit), std::move(values),
        [access](const Object& object) { return value_json(access(object)); },
        [access](Object& object, const nlohmann::json& value, const FieldLocation&) {
          set_value(value, access(object));
        },
        std::move(help));
  }

  /// Adds a field with conversions.
  Field<Object>& add(std::string path, std::string title, std::string unit, Values values, Get get,
                     Set set, std::string help) {
    Field<Object>& field = fields_.emplace_back();
    field.path = std::move(path);
    field.title = std::move(title);
    field.unit = std::move(unit);
    field.values = std::move(values);
    field.help = std::move(help);
    field.get = std::move(get);
    field.set = std::move(set);
    field.default_value = plain_numbers(field.get(Object{}));
    return field;
  }

  /// Adds a field that is read but never printed.
  Field<Object>& add_read(std::string path, Values values, Set set, std::string help = "") {
    return add(
        std::move(path), "", "", std::move(values), [](const Object&) { return nlohmann::json(); },
        std::move(set), std::move(help));
  }

  /// Adds a field that is checked, but has no meaning for the program.
  Field<Object>& add_ignored(std::string path, Values values, std::string help) {
    return add_read(
        std::move(path), std::move(values),
        [](Object&, const nlohmann::json&, const FieldLocation&) {}, std::move(help));
  }

  /// Adds the field with which a file names its schema.
  Field<Object>& add_schema_name() {
    return add_ignored("$schema", raw({{"type", "string"}}),
                       "The schema that an editor completes and checks with.");
  }

  /// Adds a field for an enumeration, written as one of `words` in the order of its values.
  template <typename Words, typename Access>
  Field<Object>& add_word(std::string path, std::string title, const Words& words, Access access,
                          std::string help) {
    return add(
        std::move(path), std::move(title), "", one_of_words(words),
        [words, access](const Object& object) -> nlohmann::json {
          return words.at(static_cast<std::size_t>(access(object)));
        },
        [words, access](Object& object, const nlohmann::json& value, const FieldLocation&) {
          using Enum = std::remove_cvref_t<decltype(access(object))>;
          const auto& word = value.get_ref<const std::string&>();
          for (std::size_t i = 0; i < words.size(); ++i) {
            if (word == words.at(i)) access(object) = static_cast<Enum>(i);
          }
        },
        std::move(help));
  }

  /// Adds an object with fields of its own that may be missing, in which case it stays empty.
  template <typename Part, typename Access>
  Field<Object>& add_object(std::string path, const FieldTable<Part>& part, Access access,
                            std::string help) {
    return add(
        std::move(path), "", "", object_with(part.schema()),
        [&part, access](const Object& object) {
          const std::optional<Part>& value = access(object);
          return value ? part.print(*value) : nlohmann::json();
        },
        [&part, access](Object& object, const nlohmann::json& value, const FieldLocation& place) {
          part.read_checked(value, access(object).emplace(), place);
        },
        std::move(help));
  }

  /// Adds a list of at least `min_items` objects with fields of their own; it is not printed.
  template <typename Part, typename Access>
  Field<Object>& add_list(std::string path, const FieldTable<Part>& part, Access access,
                          std::string help, int min_items = 0) {
    return add_read(
        std::move(path), open_lists(min_items, object_with(part.schema()).rules),
        [&part, access](Object& object, const nlohmann::json& list, const FieldLocation& place) {
          access(object) = part.read_list(list, place);
        },
        std::move(help));
  }

  /// Adds the fields of a part of the object, with the prefix `path`; "": without a prefix.
  template <typename Part, typename Access>
  void add_all(const std::string& path, const FieldTable<Part>& part, Access access) {
    for (const Field<Part>& other : part.fields()) {
      Field<Object>& field = fields_.emplace_back();
      static_cast<FieldRules&>(field) = other;
      field.path = path.empty() ? other.path : path + "/" + other.path;
      if (other.is_group) continue;
      field.get = [access, get = other.get](const Object& object) { return get(access(object)); };
      field.set = [access, set = other.set](Object& object, const nlohmann::json& value,
                                            const FieldLocation& place) {
        set(access(object), value, place);
      };
    }
  }

  const Fields& fields() const { return fields_; }

  /// Returns the field with this path, or null.
  const Field<Object>* find(std::string_view path) const {
    for (const Field<Object>& field : fields_) {
      if (field.path == path) return &field;
    }
    return nullptr;
  }

  /// Reads an object that has been checked against the schema; members without a value do not
  /// change. `place` is the position of the object.
  void read(const nlohmann::json& value, Object& object, const FieldLocation& place) const {
    for_each_given(value, place,
                   [&](const Field<Object>& field, const nlohmann::json& given,
                       const FieldLocation& at) { field.set(object, given, at); });
  }

  /// Checks an object and reads its valid values. Adds a problem for each unknown name, missing
  /// required field and invalid value.
  void read_checked(const nlohmann::json& value, Object& object, const FieldLocation& place) const {
    if (!check_object(value, rules(), place)) return;
    for_each_given(
        value, place,
        [&](const Field<Object>& field, const nlohmann::json& given, const FieldLocation& at) {
          if (check_value(given, field.values, at)) field.set(object, given, at);
        });
  }

  /// Reads the elements of a list as read_checked() does.
  std::vector<Object> read_list(const nlohmann::json& list, const FieldLocation& place) const {
    std::vector<Object> objects(list.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
      read_checked(list[i], objects[i], place.below(i));
    }
    return objects;
  }

  /// Returns the object as JSON.
  nlohmann::json print(const Object& object) const {
    nlohmann::json value = nlohmann::json::object();
    for (const Field<Object>& field : fields_) {
      if (field.is_group) continue;
      nlohmann::json printed = field.get(object);
      if (!printed.is_null()) value[pointer_below(field.path)] = std::move(printed);
    }
    return value;
  }

  /// Returns the schema of the object: "properties", and "required" if there are required fields.
  nlohmann::ordered_json schema() const { return schema_for(rules()); }

  /// The rules of all fields.
  std::vector<const FieldRules*> rules() const {
    std::vector<const FieldRules*> rules;
    rules.reserve(fields_.size());
    for (const Field<Object>& field : fields_) rules.push_back(&field);
    return rules;
  }

 private:
  /// Calls visit(field, value, location) for the fields that `value` has, by their names or
  /// deprecated names.
  template <typename Visit>
  void for_each_given(const nlohmann::json& value, const FieldLocation& place, Visit visit) const {
    for (const Field<Object>& field : fields_) {
      if (field.is_group) continue;
      const nlohmann::json* found = value_at(value, field.path);
      if (found != nullptr) visit(field, *found, place.below(field.path));
      if (field.deprecated_name.empty()) continue;
      const FieldLocation old = place.below(deprecated_path(field));
      const nlohmann::json* found_old = value_at(value, deprecated_path(field));
      if (found_old == nullptr || !old.allows_deprecated(field, found != nullptr)) continue;
      visit(field, *found_old, old);
    }
  }

  Fields fields_;
};

// NOLINTEND(performance-unnecessary-value-param)

}  // namespace throng::fields
