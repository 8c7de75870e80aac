#include "spec/metrics/trajectory_format.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"

namespace throng::metrics {

namespace {

constexpr const char* kSource = "--columns";

/// The text of a column's number if exactly one of the words is in `names`; "" if none is.
std::string column_number(const std::vector<std::string>& words,
                          std::initializer_list<std::string_view> names) {
  std::string number;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::find(names.begin(), names.end(), words[i]) == names.end()) continue;
    if (!number.empty()) {
      throw InputError({kSource, "", fmt::format("\"{}\" again", words[i]), "each column once"});
    }
    number = std::to_string(i + 1);
  }
  return number;
}

}  // namespace

TrajectoryColumns columns_in_order(const std::string& roles) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= roles.size();) {
    const std::size_t end = std::min(roles.find(',', at), roles.size());
    words.push_back(lower_case(trimmed(std::string_view(roles).substr(at, end - at), " ")));
    at = end + 1;
  }
  TrajectoryColumns columns{column_number(words, {"id", "person", "ped"}),
                            column_number(words, {"frame"}), column_number(words, {"time", "t"}),
                            column_number(words, {"x"}), column_number(words, {"y"})};
  const bool is_when_clear = columns.frame.empty() != columns.time.empty();
  if (columns.person.empty() || !is_when_clear || columns.x.empty() || columns.y.empty()) {
    throw InputError({kSource, "", fmt::format("\"{}\"", roles),
                      "id, x, y and either frame or time, in the order of the columns, such as "
                      "frame,id,x,y; - for columns that are not read"});
  }
  return columns;
}

}  // namespace throng::metrics
