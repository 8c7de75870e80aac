// The head of the COCO file: info, licenses and categories with names of keypoints, skeleton,
// joints and bones.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>

#include "annotate/people/coco.h"
#include "annotate/people/person_record.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_text.h"
#include "checks/findings.h"

namespace throng::checks {

using annotate::GroundTruth;
using nlohmann::json;

namespace {

/// Everything before the file's first record; null if that is no JSON.
json head_of_file(const formats::DatasetInfo& info) {
  std::ifstream file = open_stream(info.root / formats::kCocoFile);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("\"images\":") || line.starts_with("\"tracks\":")) break;
    text += line;
  }
  if (text.ends_with(',')) text.pop_back();
  const json head = parse_json_or_discard(text + "}", kOwnJsonLimits);
  return head.is_object() ? head : json();
}

/// Numbers and names of categories; those of an earlier version have no more to be compared with.
void check_category_names(const json& categories, Findings& findings) {
  if (!categories.is_array()) return;
  for (const json& category : categories) {
    const json id = category.value("id", json());
    std::string_view expected = id == annotate::kPersonCategory ? "person" : "";
    for (const annotate::ObjectCategory& known : annotate::kObjectCategories) {
      if (id == known.id) expected = known.name;
    }
    if (category.value("name", "") == expected) continue;
    findings.add("category", formats::kCocoFile, "categories",
                 fmt::format("{} is called {}, expected 1, person, 2, drone, 3, car, and 4, train",
                             id.dump(), category.value("name", json()).dump()));
  }
}

bool has_object(const formats::DatasetInfo& info, int category) {
  return std::any_of(info.object_categories.begin(), info.object_categories.end(),
                     [&](const annotate::ObjectCategory& known) { return known.id == category; });
}

std::string version_in(const json& head) {
  return head.is_object() ? head.value("info", json::object()).value("version", "") : "";
}

}  // namespace

int label_version(const formats::DatasetInfo& info) {
  const std::string text = version_in(head_of_file(info));
  int version = 0;
  std::from_chars(text.data(), text.data() + text.size(), version);
  return version;
}

void check_categories(const formats::DatasetInfo& info, Findings& findings) {
  const json found = head_of_file(info);
  if (!found.is_object()) {
    return findings.add("category", formats::kCocoFile, "", "info and categories are no JSON");
  }
  check_category_names(found.value("categories", json()), findings);
  if (version_in(found) != annotate::kLabelVersion) return;
  const json expected = parse_json_or_discard(
      annotate::coco_head(info.name, {.keypoints = info.has(GroundTruth::keypoints),
                                      .drones = has_object(info, annotate::kDroneCategory),
                                      .vehicles = info.has(GroundTruth::vehicles),
                                      .skeletons = info.has(GroundTruth::skeletons)}) +
          "}",
      kOwnJsonLimits);
  for (const json& change : json::diff(expected, found)) {
    const json::json_pointer at(change.at("path").get<std::string>());
    findings.add(
        "category", formats::kCocoFile, at.to_string(),
        fmt::format("{}, expected {}", found.contains(at) ? found.at(at).dump() : "nothing",
                    expected.contains(at) ? expected.at(at).dump() : "nothing"));
    return;  // the rest is often the same
  }
}

}  // namespace throng::checks
