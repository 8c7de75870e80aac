// The head of the COCO file.
#include <fmt/format.h>

#include <fstream>
#include <string>

#include "annotate/person_record.h"
#include "base/json_text.h"
#include "formats/findings.h"

namespace throng::formats {

using nlohmann::json;

void check_categories(const DatasetInfo& info, Findings& findings) {
  const std::string kStart = "\"categories\":";
  std::ifstream file(info.root / kCocoFile);
  std::string line;
  while (std::getline(file, line) && !line.starts_with(kStart)) {
    if (line.starts_with("\"images\":") || line.starts_with("\"tracks\":")) return;
  }
  if (line.ends_with(',')) line.pop_back();
  if (!line.starts_with(kStart)) return;
  const json categories = parse_json_or_discard(line.substr(kStart.size()), kOwnJsonLimits);
  if (!categories.is_array()) return;
  for (const json& category : categories) {
    const json id = category.value("id", json());
    std::string_view expected = id == annotate::kPersonCategory ? "person" : "";
    for (const annotate::ObjectCategory& known : annotate::kObjectCategories) {
      if (id == known.id) expected = known.name;
    }
    if (category.value("name", "") == expected) continue;
    findings.add("category", kCocoFile, "categories",
                 fmt::format("{} is called {}, expected 1, person, 2, drone, 3, car, and 4, train",
                             id.dump(), category.value("name", json()).dump()));
  }
}

}  // namespace throng::formats
