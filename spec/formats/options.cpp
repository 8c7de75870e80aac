#include "spec/formats/options.h"

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
      {"state",
       {"waiting", "walking", "running", "following", "panicking", "lying", "falling", "getting_up",
        "sitting", "squatting"}},
      {"carries",
       {"nothing", "backpack", "shoulder bag", "handbag", "umbrella", "walking stick", "suitcase",
        "pram", "bicycle"}},
  };
  return table;
}

}  // namespace

void settle_shares(bool has_train, const std::string& where, SplitOptions& splits,
                   std::vector<Problem>& problems) {
  constexpr double kRounding = 1e-9;  // of decimals that sum to 1
  double& train = splits.share[static_cast<std::size_t>(Split::train)];
  double others = 0;
  for (const Split split : {Split::val, Split::test}) {
    others += splits.share[static_cast<std::size_t>(split)];
  }
  if (!has_train) train = others < 1 - kRounding ? 1 - others : 0;
  const double sum = train + others;
  if (!(sum <= 1 + kRounding)) {
    problems.push_back(
        {"", where, fmt::format("shares that sum to {:g}", sum), "shares that sum to at most 1"});
  } else if (sum <= 0) {
    problems.push_back({"", where, "no share above 0", "at least one"});
  }
}

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
