#include "jobs/pipeline/checks/catalog.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/export/exporter.h"
#include "sim/policies/policy_table.h"
#include "sim/vehicle/battery.h"
#include "skinning/items.h"
#include "skinning/population.h"
#include "skinning/population_files.h"
#include "spec/sim/airframe.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

json airframe_list() {
  json list = json::array();
  for (const sim::Airframe& airframe : sim::shipped_airframes()) {
    json entry = to_json(airframe);
    entry["name"] = airframe.name;
    entry["derived"] = {{"top_speed_mps", airframe.top_speed_mps()},
                        {"endurance_s", sim::hover_endurance_s(airframe)},
                        {"hover_power_w", sim::hover_power_w(airframe)}};
    list.push_back(std::move(entry));
  }
  return list;
}

json format_list() {
  json list = json::array();
  for (const formats::Format& format : formats::all_formats()) {
    std::string needs;
    for (const annotate::GroundTruth kind : {format.needs, format.needs_also}) {
      if (kind == annotate::GroundTruth::coco) continue;
      if (!needs.empty()) needs += ", ";
      needs += annotate::ground_truth_kind(kind).name;
    }
    list.push_back({{"name", format.name}, {"summary", format.summary}, {"needs", needs}});
  }
  return list;
}

json policy_list() {
  json list = json::array();
  for (const sim::PolicyEntry& policy : sim::policies()) {
    list.push_back({{"name", policy.name}, {"flies_free", policy.flies_free}});
  }
  return list;
}

}  // namespace

json catalog() {
  return {{"airframes", airframe_list()}, {"formats", format_list()}, {"policies", policy_list()}};
}

json people_catalog() {
  const std::filesystem::path folder = skinning::population_folder();
  if (!std::filesystem::exists(folder / skinning::kIndexFile)) return nullptr;
  const skinning::PopulationIndex index = skinning::read_index(folder);
  json list = json::array();
  for (const skinning::Character& character : index.characters) {
    list.push_back({{"name", character.name},
                    {"sex", character.male ? "male" : "female"},
                    {"age_years", character.age_years},
                    {"stature_m", character.stature_m},
                    {"carries", skinning::kCarryNames[static_cast<std::size_t>(character.carries)]},
                    {"wears", character.wears}});
  }
  return {{"content_hash", index.content_hash},
          {"licence", index.license},
          {"people", std::move(list)}};
}

}  // namespace throng::jobs
