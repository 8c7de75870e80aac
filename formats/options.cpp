#include "formats/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace throng::formats {

namespace {

using Property = std::pair<std::string_view, std::vector<std::string>>;

const std::vector<Property>& properties() {
  static const std::vector<Property> table = {
      {"none", {"person"}},
      {"sex", {"female", "male"}},
      {"age_band", {"child", "teenager", "adult", "senior"}},
      {"state", {"waiting", "walking", "running", "following", "panicking", "lying"}},
      {"carries", {"nothing", "backpack", "shoulder bag", "handbag", "umbrella"}},
  };
  return table;
}

}  // namespace

std::vector<std::string> class_values(std::string_view property) {
  for (const auto& [name, values] : properties()) {
    if (name == property) return values;
  }
  return {};
}

void add_class_name(const std::string& text, const std::string& where, ClassOptions& classes) {
  const std::size_t equals = text.find('=');
  const std::vector<std::string> values = class_values(classes.by);
  const std::string value = text.substr(0, equals);
  if (equals == std::string::npos || equals + 1 == text.size() ||
      std::find(values.begin(), values.end(), value) == values.end()) {
    throw InputError(
        {"", where, text, fmt::format("VALUE=NAME, VALUE one of: {}", fmt::join(values, ", "))});
  }
  classes.names[value] = text.substr(equals + 1);
}

std::vector<std::string_view> class_properties() {
  std::vector<std::string_view> names;
  for (const auto& [name, values] : properties()) names.push_back(name);
  return names;
}

}  // namespace throng::formats
