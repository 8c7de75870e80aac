// The fields of JSON objects in tables. A line of a table says everything that is known of a field:
// its path, title and help, unit, permitted values, whether runs of a job may differ in it, and
// where the program keeps it. Reading, checking, printing, schemas and tables of documentation
// follow from it. The defaults are those of the structs.
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

template <typename Object>
struct Field : FieldRules {
  /// The value as a job writes it; null: it is left out.
  std::function<nlohmann::json(const Object&)> get;
  /// `value` is what the schema allows.
  std::function<void(Object&, const nlohmann::json& value, const FieldLocation&)> set;

  Field& randomized() {
    sampling = Sampling::by_randomize;
    return *this;
  }
  Field& required() {
    is_required = true;
    default_value = nullptr;
    return *this;
  }
  /// The schema's default of a field that printed jobs leave out.
  Field& with_default(nlohmann::ordered_json value) {
    default_value = std::move(value);
    return *this;
  }
  /// The field was called `name` in an earlier version. Not for fields that may be sampled.
  Field& renamed_from(std::string name) {
    deprecated_name = std::move(name);
    return *this;
  }
  /// Marks an object that is there only if it is given: help says what happens without it.
  Field& without_default() {
    default_value = nullptr;
    return *this;
  }
};

/// The member of a member: at(&JobSpec::capture, &CaptureSpec::rate_hz).
template <typename... Members>
constexpr auto at(Members... members) {
  return [members...](auto& object) -> auto& { return (object.*....*members); };
}

/// Values as a job writes them.
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

/// The fields of one kind of object, in the order of the schema.
template <typename Object>
class FieldTable {
 public:
  using Fields = std::vector<Field<Object>>;
  using Get = std::function<nlohmann::json(const Object&)>;
  using Set = std::function<void(Object&, const nlohmann::json&, const FieldLocation&)>;

  /// Begins an object that has its defaults when it is left out.
  Field<Object>& group(std::string path, std::string title, std::string help) {
    Field<Object>& field = fields_.emplace_back();
    field.path = std::move(path);
    field.title = std::move(title);
    field.help = std::move(help);
    field.is_group = true;
    field.default_value = nlohmann::ordered_json::object();
    return field;
  }

  /// A field that is kept where `access` says (at()).
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

  /// A field that is converted.
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

  /// A field that is read and never printed.
  Field<Object>& add_read(std::string path, Values values, Set set) {
    return add(
        std::move(path), "", "", std::move(values), [](const Object&) { return nlohmann::json(); },
        std::move(set), "");
  }

  /// An enumerator that is written as one of `words`.
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

  /// The fields of a part of the object, with `path` before theirs.
  template <typename Part, typename Access>
  void add_all(const std::string& path, const FieldTable<Part>& part, Access access) {
    for (const Field<Part>& other : part.fields()) {
      Field<Object>& field = fields_.emplace_back();
      static_cast<FieldRules&>(field) = other;
      field.path = path + "/" + other.path;
      if (other.is_group) continue;
      field.get = [access, get = other.get](const Object& object) { return get(access(object)); };
      field.set = [access, set = other.set](Object& object, const nlohmann::json& value,
                                            const FieldLocation& place) {
        set(access(object), value, place);
      };
    }
  }

  const Fields& fields() const { return fields_; }

  /// Null if there is none of this path.
  const Field<Object>* find(std::string_view path) const {
    for (const Field<Object>& field : fields_) {
      if (field.path == path) return &field;
    }
    return nullptr;
  }

  /// Reads an object that a schema has been held against; what it leaves out stays as it is.
  /// `place` is the object's.
  void read(const nlohmann::json& value, Object& object, const FieldLocation& place) const {
    for_each_given(value, place,
                   [&](const Field<Object>& field, const nlohmann::json& given,
                       const FieldLocation& at) { field.set(object, given, at); });
  }

  /// Checks an object and reads what is right of it. Adds a problem for each unknown name, missing
  /// required field and value that breaks its field's rules.
  void read_checked(const nlohmann::json& value, Object& object, const FieldLocation& place) const {
    if (!check_object(value, rules(), place)) return;
    for_each_given(
        value, place,
        [&](const Field<Object>& field, const nlohmann::json& given, const FieldLocation& at) {
          if (check_value(given, field, at)) field.set(object, given, at);
        });
  }

  nlohmann::json print(const Object& object) const {
    nlohmann::json value = nlohmann::json::object();
    for (const Field<Object>& field : fields_) {
      if (field.is_group) continue;
      nlohmann::json printed = field.get(object);
      if (!printed.is_null()) value[pointer_below(field.path)] = std::move(printed);
    }
    return value;
  }

  /// "required", if there are such fields, and "properties", of the object that the table
  /// describes.
  nlohmann::ordered_json schema() const { return schema_for(rules()); }

 private:
  /// Calls visit(field, value, its place) for the fields that `value` has, under their names or
  /// their deprecated names.
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

  std::vector<const FieldRules*> rules() const {
    std::vector<const FieldRules*> rules;
    rules.reserve(fields_.size());
    for (const Field<Object>& field : fields_) rules.push_back(&field);
    return rules;
  }

  Fields fields_;
};

// NOLINTEND(performance-unnecessary-value-param)

}  // namespace throng::fields
