#include "spec/job/schema_problems.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

#include "spec/job/schema.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

/// The nearest member of an object at or above a pointer that can be left out; "" if there is none.
/// Elements of arrays stay: others would take their places.
json::json_pointer removable(const json& job, json::json_pointer pointer) {
  while (!pointer.empty() &&
         (!job.contains(pointer) || !job.at(pointer.parent_pointer()).is_object())) {
    pointer = pointer.parent_pointer();
  }
  return pointer;
}

/// Whether `pointer` is `other` or below it.
bool is_at_or_below(const std::string& pointer, const std::string& other) {
  return pointer == other || pointer.starts_with(other + "/");
}

/// Deprecated names in a value at a pointer, which the schema's `rules` describe.
void add_deprecated(const json& value, const json& rules, const std::string& pointer,
                    std::vector<Problem>& warnings) {
  if (value.is_array() && rules.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      add_deprecated(value[i], rules["items"], fmt::format("{}/{}", pointer, i), warnings);
    }
  }
  if (!value.is_object() || !rules.contains("properties")) return;
  for (const auto& [name, member] : value.items()) {
    const auto found = rules["properties"].find(name);
    if (found == rules["properties"].end()) continue;
    const std::string below = pointer + "/" + name;
    if (const auto now = found->find("x-renamed-to"); now != found->end()) {
      warnings.push_back({"", below, fmt::format("the deprecated name \"{}\"", name), now->dump()});
    }
    add_deprecated(member, *found, below, warnings);
  }
}

}  // namespace

SchemaProblems::SchemaProblems(json document, const std::string& source)
    : job_(std::move(document)), problems_(schema_problems(job_, source)) {
  // The rest may break the schema in turn, where a required value was wrong: then its object
  // goes, too.
  std::vector<Problem> left = problems_;
  while (!left.empty()) {
    std::set<std::string> pointers;
    for (const Problem& problem : left) {
      const json::json_pointer pointer = removable(job_, json::json_pointer(problem.where));
      if (pointer.empty()) return;
      pointers.insert(pointer.to_string());
    }
    for (const std::string& pointer : pointers) {
      const json::json_pointer place(pointer);
      if (!job_.contains(place)) continue;  // went with what it lay in
      job_.at(place.parent_pointer()).erase(place.back());
      removed_.push_back(pointer);
    }
    left = schema_problems(job_, source);
  }
  is_valid_ = true;
}

bool SchemaProblems::may_cause(const Problem& problem) const {
  return std::any_of(removed_.begin(), removed_.end(), [&](const std::string& removed) {
    const std::string parent = removed.substr(0, removed.rfind('/'));
    return is_at_or_below(problem.where, removed) ||
           (!parent.empty() && is_at_or_below(problem.where, parent));
  });
}

std::vector<Problem> deprecated_fields(const json& document) {
  std::vector<Problem> warnings;
  add_deprecated(document, job_schema(), "", warnings);
  return warnings;
}

}  // namespace throng::jobs
