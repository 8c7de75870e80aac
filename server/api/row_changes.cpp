#include "server/api/row_changes.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json/json_integer.h"
#include "base/text/control_characters.h"
#include "base/text/utf8.h"
#include "jobs/queue/store/store.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/http/http.h"

namespace throng::server {

using httplib::Request;
using nlohmann::json;

namespace {

HttpError wrong_change(const std::string& pointer, const std::string& found,
                       const std::string& expected) {
  return {400, "the change is wrong", {{"", pointer, found, expected}}};
}

}  // namespace

void check_labels(const std::vector<std::string>& labels, const std::string& pointer) {
  const auto is_wrong = [](const std::string& label) {
    return label.empty() || label.size() > kMaxLabelLength || !is_utf8(label) ||
           has_control_characters(label);
  };
  const auto invalid = std::find_if(labels.begin(), labels.end(), is_wrong);
  if (invalid == labels.end() && labels.size() <= kMaxLabels) return;
  const std::string found =
      invalid == labels.end() ? fmt::format("{} labels", labels.size()) : '"' + *invalid + '"';
  throw HttpError{400,
                  "labels are wrong",
                  {{"", pointer, found,
                    fmt::format("at most {} labels of 1 to {} printable characters", kMaxLabels,
                                kMaxLabelLength)}}};
}

void require_priority(const Caller& caller, int priority, const std::string& pointer) {
  if (priority <= caller.max_priority) return;
  throw HttpError{
      403,
      "this key may not give its jobs that priority",
      {{"", pointer, std::to_string(priority), fmt::format("at most {}", caller.max_priority)}}};
}

jobs::JobChange read_change(const Caller& caller, const Request& request, const jobs::JobRow& row) {
  require_json(request);
  const json change = parse_json_body(request);
  if (!change.is_object())
    throw wrong_change("", "no JSON object", "priority, labels, keep or some of them");
  jobs::JobChange wanted{row.priority, row.labels, row.keep};
  for (const auto& [name, value] : change.items()) {
    if (name == "priority") {
      if (!is_integer(value) || value < -kMaxPriority || value > kMaxPriority) {
        throw wrong_change("/priority", value.dump(), "an integer from -100 to 100");
      }
      wanted.priority = value;
      // An administrator may have raised it: then it may stay.
      if (wanted.priority > row.priority) require_priority(caller, wanted.priority, "/priority");
    } else if (name == "labels") {
      const bool is_list =
          value.is_array() && std::all_of(value.begin(), value.end(),
                                          [](const json& label) { return label.is_string(); });
      if (!is_list) throw wrong_change("/labels", value.dump(), "a list of texts");
      wanted.labels = value.get<std::vector<std::string>>();
      check_labels(wanted.labels, "/labels");
    } else if (name == "keep") {
      if (!value.is_boolean()) throw wrong_change("/keep", value.dump(), "true or false");
      wanted.keep = value;
    } else {
      throw wrong_change("/" + name, fmt::format("unknown field \"{}\"", name),
                         "one of: priority, labels, keep");
    }
  }
  return wanted;
}

}  // namespace throng::server
