#include "jobs/pipeline/checks/ground_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>

#include "annotate/rasters/ground_field.h"
#include "annotate/rasters/zone_counts.h"
#include "spec/annotate/ground_truth.h"

namespace throng::jobs {

using annotate::GroundTruth;

namespace {

/// Cells, zones and lines need the annotation that they are for.
void check_kinds(const OutputSpec& outputs, std::vector<Problem>& problems) {
  const auto needs = [&](bool is_given, GroundTruth kind, const char* pointer) {
    if (!is_given || holds(outputs.annotations, kind)) return;
    const std::string_view name = annotate::ground_truth_kind(kind).name;
    problems.push_back({"", pointer, fmt::format("no annotation {}", name),
                        fmt::format("\"{}\" among outputs.annotations, too", name)});
  };
  needs(!outputs.field_cells_m.empty(), GroundTruth::fields, "/outputs/fields/cells_m");
  needs(!outputs.counts.zones.empty(), GroundTruth::counts, "/outputs/counts/zones");
  needs(!outputs.counts.lines.empty(), GroundTruth::counts, "/outputs/counts/lines");
  const std::vector<double>& cells_m = outputs.field_cells_m;
  for (std::size_t i = 0; i < cells_m.size(); ++i) {
    if (std::find(cells_m.begin(), cells_m.begin() + static_cast<std::ptrdiff_t>(i), cells_m[i]) ==
        cells_m.begin() + static_cast<std::ptrdiff_t>(i)) {
      continue;
    }
    problems.push_back({"", fmt::format("/outputs/fields/cells_m/{}", i),
                        fmt::format("{} m once more", cells_m[i]), "each size once"});
  }
}

/// Names of areas are unique, those of the scenario's exits included; cells are not finer than the
/// grid that they are made from.
void check_ground(const OutputSpec& outputs, const world::Scenario& scenario,
                  std::vector<Problem>& problems) {
  std::set<std::string> known = {annotate::kGroundZone};
  for (const world::Exit& exit : scenario.exits) known.insert(exit.id);
  const auto check_id = [&](const std::string& id, const char* list, std::size_t i) {
    if (known.insert(id).second) return;
    problems.push_back({"", fmt::format("/outputs/counts/{}/{}/id", list, i),
                        fmt::format("\"{}\", which another area or an exit has", id),
                        "a name of its own"});
  };
  for (std::size_t i = 0; i < outputs.counts.zones.size(); ++i) {
    check_id(outputs.counts.zones[i].id, "zones", i);
  }
  for (std::size_t i = 0; i < outputs.counts.lines.size(); ++i) {
    check_id(outputs.counts.lines[i].id, "lines", i);
  }
  const double finest_m = annotate::ground_cell_m(scenario.ground);
  for (std::size_t i = 0; i < outputs.field_cells_m.size(); ++i) {
    if (outputs.field_cells_m[i] >= finest_m) continue;
    problems.push_back(
        {"", fmt::format("/outputs/fields/cells_m/{}", i),
         fmt::format("{} m", outputs.field_cells_m[i]),
         fmt::format("at least {} m, the cells of the fields of this ground", finest_m)});
  }
}

}  // namespace

void check_ground_outputs(const OutputSpec& outputs, const std::vector<world::Scenario>& scenarios,
                          std::vector<Problem>& problems) {
  check_kinds(outputs, problems);
  for (const world::Scenario& scenario : scenarios) check_ground(outputs, scenario, problems);
}

}  // namespace throng::jobs
