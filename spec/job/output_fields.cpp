// The fields below "outputs": which ground truth and which other formats, how runs are split, who
// is worth a label, what classes.
#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/text/suggest.h"
#include "spec/annotate/ground_truth.h"
#include "spec/bucket/address.h"
#include "spec/formats/options.h"
#include "spec/job/ground_fields.h"
#include "spec/job/job_fields.h"
#include "spec/job/plan.h"
#include "spec/job/scenario_mix.h"

namespace throng::jobs {

using formats::ClassOptions;
using formats::ExportOptions;
using formats::FilterOptions;
using formats::Split;
using formats::WebDatasetOptions;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

Values ground_truth_values() {
  ordered_json names = ordered_json::array();
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    names.push_back(kind.name);
  }
  const std::size_t count = names.size();
  return raw({{"type", "array"},
              {"uniqueItems", true},
              {"maxItems", count},
              {"items", {{"type", "string"}, {"enum", std::move(names)}}}});
}

auto split_share(Split split) {
  return [split](auto& job) -> auto& {
    return job.outputs.exports.splits.share.at(static_cast<std::size_t>(split));
  };
}

FieldTable<JobSpec>::Get runs_getter(Split split) {
  return [split](const JobSpec& job) {
    json named = json::array();
    for (const auto& [run, its_split] : job.outputs.exports.splits.runs) {
      if (its_split == split) named.push_back(std::stoi(run.substr(3)));
    }
    return named;
  };
}

/// Puts a run into a split.
void assign_run(JobSpec& job, int run, Split split, const std::string& pointer,
                std::vector<Problem>& problems) {
  if (job.outputs.exports.splits.runs.emplace(run_name(run), split).second) return;
  problems.push_back(
      {"", pointer, fmt::format("run {}, which has a split already", run), "each run once"});
}

FieldTable<JobSpec>::Set runs_setter(Split split) {
  return [split](JobSpec& job, const json& value, const FieldLocation& place) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const int run = value[i].get<int>();
      const std::string pointer = place.below(std::to_string(i)).pointer;
      if (run >= job.runs) {
        place.problems.push_back({"", pointer, fmt::format("run {}", run),
                                  fmt::format("a run of the job, 0 to {}", job.runs - 1)});
      } else {
        assign_run(job, run, split, pointer, place.problems);
      }
    }
  };
}

/// Runs of scenarios, which are runs from there on.
FieldTable<JobSpec>::Set scenarios_setter(Split split) {
  return [split](JobSpec& job, const json& value, const FieldLocation& place) {
    std::vector<std::string_view> ids;
    for (const ScenarioShare& share : job.mix) ids.emplace_back(share.scenario);
    if (ids.empty()) ids.emplace_back(job.scenario);
    const std::vector<std::size_t> shares = shares_of_runs(job);
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto& id = value[i].get_ref<const std::string&>();
      const std::string pointer = place.below(std::to_string(i)).pointer;
      for (std::size_t run = 0; run < shares.size(); ++run) {
        if (ids[shares[run]] != id) continue;
        assign_run(job, static_cast<int>(run), split, pointer, place.problems);
      }
      if (std::find(ids.begin(), ids.end(), id) != ids.end()) continue;
      place.problems.push_back(unknown_name("", pointer, "scenario", id, ids));
    }
  };
}

Values split_scenarios() {
  return raw({{"type", "array"}, {"maxItems", 64}, {"items", texts(1, 200).rules}});
}

/// They are printed as runs.
json no_scenarios(const JobSpec& /*job*/) { return {}; }

json class_names_json(const JobSpec& job) {
  json names = json::array();
  for (const auto& [value, name] : job.outputs.exports.classes.names) {
    names.push_back(value + "=" + name);
  }
  return names;
}

void set_class_names(JobSpec& job, const json& value, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    try {
      formats::add_class_name(value[i], place.below(std::to_string(i)).pointer,
                              job.outputs.exports.classes);
    } catch (const InputError& error) {
      place.problems.push_back(error.problems().front());
    }
  }
}

json publish_json(const JobSpec& job) { return value_json(job.outputs.publish); }

void set_publish(JobSpec& job, const json& value, const FieldLocation& place) {
  try {
    const auto& text = value.get_ref<const std::string&>();
    job.outputs.publish = bucket::parse_address(text, "", place.pointer).text();
  } catch (const InputError& error) {
    place.problems.push_back(error.problems().front());
  }
}

void add_split_fields(FieldTable<JobSpec>& table) {
  table.group("outputs/splits", "Splits", "Assignment of runs to splits in other formats.");
  table.add("outputs/splits/train", "Training", "", numbers(0, 1), split_share(Split::train),
            "Share of the runs for training; whole runs, in their order. Default: the rest that "
            "the other two leave. The three sum to at most 1.");
  table.add("outputs/splits/val", "Validation", "", numbers(0, 1), split_share(Split::val),
            "Share of the runs for validation.");
  table.add("outputs/splits/test", "Test", "", numbers(0, 1), split_share(Split::test),
            "Share of the runs for tests.");
  table.add("outputs/splits/train_runs", "Training runs by number", "",
            raw({{"type", "array"}, {"maxItems", 1000}, {"items", integers(0, 999).rules}}),
            runs_getter(Split::train), runs_setter(Split::train),
            "Runs that are in train regardless of the shares.");
  table.add("outputs/splits/train_scenarios", "Training runs by scenario", "", split_scenarios(),
            no_scenarios, scenarios_setter(Split::train),
            "Scenarios of which every run is in train regardless of the shares.");
  table.add("outputs/splits/val_runs", "Validation runs by number", "",
            raw({{"type", "array"}, {"maxItems", 1000}, {"items", integers(0, 999).rules}}),
            runs_getter(Split::val), runs_setter(Split::val),
            "Runs that are in val regardless of the shares.");
  table.add("outputs/splits/val_scenarios", "Validation runs by scenario", "", split_scenarios(),
            no_scenarios, scenarios_setter(Split::val),
            "Scenarios of which every run is in val regardless of the shares.");
  table.add("outputs/splits/test_runs", "Test runs by number", "",
            raw({{"type", "array"}, {"maxItems", 1000}, {"items", integers(0, 999).rules}}),
            runs_getter(Split::test), runs_setter(Split::test),
            "Runs that are in test regardless of the shares.");
  table.add("outputs/splits/test_scenarios", "Test runs by scenario", "", split_scenarios(),
            no_scenarios, scenarios_setter(Split::test),
            "Scenarios of which every run is in test regardless of the shares.");
}

void add_filter_fields(FieldTable<JobSpec>& table) {
  table.group("outputs/filters", "Filters",
              "Limits for a label in other formats; people beyond them become ignore regions if a "
              "format has them.");
  table.add("outputs/filters/min_visibility", "Min visibility", "", numbers(0, 1),
            at(&JobSpec::outputs, &OutputSpec::exports, &ExportOptions::filters,
               &FilterOptions::min_visibility),
            "Minimum visible share of a person.");
  table.add("outputs/filters/min_height_px", "Min height", "px", numbers(0, 10000),
            at(&JobSpec::outputs, &OutputSpec::exports, &ExportOptions::filters,
               &FilterOptions::min_height_px),
            "Minimum height of the whole person in the image.");
  table.add("outputs/filters/max_truncation", "Max truncation", "", numbers(0, 1),
            at(&JobSpec::outputs, &OutputSpec::exports, &ExportOptions::filters,
               &FilterOptions::max_truncation),
            "Maximum share of a person outside of the image; without it, any.");
  table.add("outputs/filters/min_contrast", "Min contrast", "CIELAB", numbers(0, 100),
            at(&JobSpec::outputs, &OutputSpec::exports, &ExportOptions::filters,
               &FilterOptions::min_contrast),
            "Minimum color difference of a person to the surroundings, in the mean or along the "
            "outline, whichever is larger; needs the annotation difficulty. About 2.3 is just "
            "noticeable.");
}

void add_export_fields(FieldTable<JobSpec>& table) {
  add_split_fields(table);
  add_filter_fields(table);
  table.group("outputs/webdataset", "WebDataset", "Options of the webdataset format.");
  table.add("outputs/webdataset/shard_mb", "Size of a shard", "MB", numbers(1, 100000),
            at(&JobSpec::outputs, &OutputSpec::exports, &ExportOptions::webdataset,
               &WebDatasetOptions::shard_mb),
            "Maximum size of a tar file of WebDataset before the next is begun, in 10^6 bytes.");
  table.group("outputs/classes", "Classes", "Classes of COCO and YOLO.");
  table.add("outputs/classes/by", "Property", "", one_of_words(formats::class_properties()),
            at(&JobSpec::outputs, &OutputSpec::exports, &ExportOptions::classes, &ClassOptions::by),
            "none: all people are one class; else a class for each value of this property.");
  table.add("outputs/classes/names", "Names", "",
            raw({{"type", "array"}, {"maxItems", 20}, {"items", texts(3, 60).rules}}),
            class_names_json, set_class_names, "Other names for values: female=woman.");
}

}  // namespace

void add_output_fields(FieldTable<JobSpec>& table) {
  table.group("outputs", "Outputs", "Contents of the dataset.");
  table.group("outputs/image", "Images", "Storage of frames.");
  table.add("outputs/image/format", "Format", "", one_of_words(std::array{"jpeg"}),
            at(&JobSpec::outputs, &OutputSpec::image_format), "File format.");
  table
      .add("outputs/image/quality", "Quality", "1 to 100", integers(1, 100),
           at(&JobSpec::outputs, &OutputSpec::image_quality), "JPEG quality.")
      .randomized();
  table.add("outputs/annotations", "Annotations", "", ground_truth_values(),
            at(&JobSpec::outputs, &OutputSpec::annotations), annotate::ground_truth_help());
  table.group("outputs/density", "Density maps", "Kernel of the heads.");
  table
      .add("outputs/density/sigma_px", "Sigma", "px", numbers(0.5, 64),
           at(&JobSpec::outputs, &OutputSpec::density_sigma_px),
           "Standard deviation of the Gaussian of one head.")
      .randomized();
  add_ground_fields(table);
  table.add("outputs/previews", "Previews", "images", integers(0, 100),
            at(&JobSpec::outputs, &OutputSpec::previews),
            "Images with the annotations drawn on them per run and camera, evenly spread over the "
            "frames.");
  table.add("outputs/formats", "Formats", "",
            raw({{"type", "array"}, {"maxItems", 100}, {"items", texts(1, 40).rules}}),
            at(&JobSpec::outputs, &OutputSpec::formats),
            "Additional formats of the dataset, below formats/: names that throng "
            "export --list prints.");
  table.add("outputs/publish", "Publish to", "", texts(1, 600), publish_json, set_publish,
            "Address in an object store, s3://BUCKET/PREFIX, that the finished dataset is brought "
            "to; credentials come from the environment and never stand in a job "
            "(docs/publishing.md). Default: none.");
  add_export_fields(table);
}

}  // namespace throng::jobs
