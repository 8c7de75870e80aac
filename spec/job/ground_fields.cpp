#include "spec/job/ground_fields.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "base/geometry/polygon.h"

namespace throng::jobs {

using annotate::CountAreas;
using annotate::CountLine;
using annotate::CountZone;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

ordered_json titled(const char* title, const char* help, const Values& values) {
  ordered_json rules = values.rules;
  if (!values.expected.empty()) rules["x-expected"] = values.expected;
  rules["title"] = title;
  rules["description"] = help;
  return rules;
}

ordered_json area_rules(const char* title, const char* help, ordered_json places) {
  ordered_json properties = {
      {"id", titled("Id", "Unique among zones, lines and exits.", identifiers())}};
  ordered_json required = {"id"};
  for (auto& [name, rules] : places.items()) {
    required.push_back(name);
    properties[name] = rules;
  }
  return {{"title", title},
          {"description", help},
          {"type", "object"},
          {"additionalProperties", false},
          {"required", std::move(required)},
          {"properties", std::move(properties)}};
}

ordered_json zone_rules() {
  constexpr int kMaxCorners = 100;
  return area_rules(
      "Zone", "A simple polygon on the ground.",
      {{"corners", titled("Corners", "[x, y] of each, in their order.",
                          lists(3, kMaxCorners, titled("Corner", "[x, y].", coordinates(2))))}});
}

ordered_json line_rules() {
  return area_rules("Line", "A straight line on the ground; crossings to its left are inward.",
                    {{"start", titled("Start", "[x, y].", coordinates(2))},
                     {"end", titled("End", "[x, y].", coordinates(2))}});
}

json zones_json(const JobSpec& job) {
  json zones = json::array();
  for (const CountZone& zone : job.outputs.counts.zones) {
    json corners = json::array();
    for (const Eigen::Vector2d& corner : zone.corners) corners.push_back(value_json(corner));
    zones.push_back({{"id", zone.id}, {"corners", std::move(corners)}});
  }
  return zones;
}

json lines_json(const JobSpec& job) {
  json lines = json::array();
  for (const CountLine& line : job.outputs.counts.lines) {
    lines.push_back(
        {{"id", line.id}, {"start", value_json(line.from)}, {"end", value_json(line.to)}});
  }
  return lines;
}

void set_zones(JobSpec& job, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    CountZone& zone = job.outputs.counts.zones.emplace_back();
    value[i].at("id").get_to(zone.id);
    for (const json& corner : value[i].at("corners")) {
      set_value(corner, zone.corners.emplace_back());
    }
    if (geometry::is_simple(zone.corners)) continue;
    place.problems.push_back({"", place.below(std::to_string(i)).below("corners").pointer,
                              "a polygon whose edges touch each other", "a simple polygon"});
  }
}

void set_lines(JobSpec& job, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    CountLine& line = job.outputs.counts.lines.emplace_back();
    value[i].at("id").get_to(line.id);
    set_value(value[i].at("start"), line.from);
    set_value(value[i].at("end"), line.to);
    if (line.from != line.to) continue;
    place.problems.push_back({"", place.below(std::to_string(i)).pointer,
                              "a line from a place to the same place", "two places"});
  }
}

}  // namespace

void add_ground_fields(FieldTable<JobSpec>& table) {
  constexpr int kMaxLevels = 8;
  constexpr int kMaxAreas = 64;
  table.group("outputs/fields", "Fields on the ground", "Grids of the annotation fields.");
  table.add("outputs/fields/cells_m", "Cells", "m", lists(0, kMaxLevels, numbers(0.25, 1000).rules),
            at(&JobSpec::outputs, &OutputSpec::field_cells_m),
            "Sizes of cells that the fields are written with, too, below fields/RUN/cell_SIZE/. "
            "The densities of each sum to the same people.");
  table.group("outputs/counts", "Counts on the ground", "Areas of the annotation counts.");
  table.add("outputs/counts/zones", "Zones", "m", lists(0, kMaxAreas, zone_rules()), zones_json,
            set_zones,
            "Polygons on the ground in which people are counted, beside the whole ground.");
  table.add("outputs/counts/lines", "Lines", "m", lists(0, kMaxAreas, line_rules()), lines_json,
            set_lines,
            "Lines on the ground across which people are counted, beside the exits' doors.");
}

}  // namespace throng::jobs
