#include "formats/options.h"

#include <utility>

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

std::vector<std::string_view> class_properties() {
  std::vector<std::string_view> names;
  for (const auto& [name, values] : properties()) names.push_back(name);
  return names;
}

}  // namespace throng::formats
