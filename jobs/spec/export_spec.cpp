#include "jobs/spec/export_spec.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "formats/spec/options.h"
#include "jobs/spec/plan.h"

namespace throng::jobs {

using formats::Split;
using nlohmann::json;

namespace {

constexpr std::array kSplits = {Split::train, Split::val, Split::test};

std::string runs_key(Split split) { return std::string(formats::name_of(split)) + "_runs"; }

void read_splits(const json& value, int runs, formats::SplitOptions& splits,
                 std::vector<Problem>& problems) {
  for (const Split split : kSplits) {
    double& share = splits.share[static_cast<std::size_t>(split)];
    share = value.value(std::string(formats::name_of(split)), share);
    const json named = value.value(runs_key(split), json::array());
    for (std::size_t i = 0; i < named.size(); ++i) {
      const int run = named[i].get<int>();
      const std::string place = fmt::format("/outputs/splits/{}/{}", runs_key(split), i);
      if (run >= runs) {
        problems.push_back({"", place, fmt::format("run {}", run),
                            fmt::format("a run of the job, 0 to {}", runs - 1)});
      } else if (!splits.runs.emplace(run_name(run), split).second) {
        problems.push_back(
            {"", place, fmt::format("run {}, which has a split already", run), "each run once"});
      }
    }
  }
  formats::settle_shares(value.contains(formats::name_of(Split::train)), "/outputs/splits", splits,
                         problems);
}

void read_classes(const json& value, formats::ClassOptions& classes,
                  std::vector<Problem>& problems) {
  classes.by = value.value("by", classes.by);
  const json names = value.value("names", json::array());
  for (std::size_t i = 0; i < names.size(); ++i) {
    try {
      formats::add_class_name(names[i], fmt::format("/outputs/classes/names/{}", i), classes);
    } catch (const InputError& error) {
      problems.push_back(error.problems().front());
    }
  }
}

}  // namespace

void read_exports(const json& outputs, int runs, OutputSpec& spec, std::vector<Problem>& problems) {
  spec.formats = outputs.value("formats", std::vector<std::string>{});
  read_splits(outputs.value("splits", json::object()), runs, spec.exports.splits, problems);
  const json filters = outputs.value("filters", json::object());
  formats::FilterOptions& limits = spec.exports.filters;
  limits.min_visibility = filters.value("min_visibility", limits.min_visibility);
  limits.min_height_px = filters.value("min_height_px", limits.min_height_px);
  double& shard_mb = spec.exports.webdataset.shard_mb;
  shard_mb = outputs.value("webdataset", json::object()).value("shard_mb", shard_mb);
  read_classes(outputs.value("classes", json::object()), spec.exports.classes, problems);
}

json exports_json(const OutputSpec& spec) {
  const formats::ExportOptions& exports = spec.exports;
  json splits = json::object();
  for (const Split split : kSplits) {
    splits[std::string(formats::name_of(split))] =
        exports.splits.share[static_cast<std::size_t>(split)];
    json& named = splits[runs_key(split)] = json::array();
    for (const auto& [run, its_split] : exports.splits.runs) {
      if (its_split == split) named.push_back(std::stoi(run.substr(3)));
    }
  }
  json names = json::array();
  for (const auto& [value, name] : exports.classes.names) names.push_back(value + "=" + name);
  return {{"formats", spec.formats},
          {"splits", splits},
          {"filters",
           {{"min_visibility", exports.filters.min_visibility},
            {"min_height_px", exports.filters.min_height_px}}},
          {"webdataset", {{"shard_mb", exports.webdataset.shard_mb}}},
          {"classes", {{"by", exports.classes.by}, {"names", names}}}};
}

}  // namespace throng::jobs
