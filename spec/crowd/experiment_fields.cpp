// The fields of experiments.json, and the rules that span several of them.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "base/geometry/region.h"
#include "base/json/field_table.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "spec/crowd/experiment.h"
#include "spec/metrics/format_fields.h"

namespace throng::validation {

namespace fs = std::filesystem;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using fields::lists;
using fields::numbers;
using fields::object_with;
using fields::Values;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

using Corners = std::vector<Vector2d>;
using Experiments = std::vector<Experiment>;

constexpr int kMaxExperiments = 1000;
constexpr int kMaxCorners = 1000;
constexpr int kMaxObstacles = 1000;
constexpr int kMaxGoals = 20;
constexpr int kMaxPoints = 100;
constexpr std::size_t kMaxNameLength = 100;
constexpr int kMaxColumnsLength = 1000;
constexpr int kMaxPeople = 10'000;
constexpr double kMaxCoordinateM = 500;
constexpr double kMaxTimeS = 7200;
constexpr double kShortestM = 0.1;
constexpr JsonLimits kLimits = {.max_bytes = 16 << 20, .max_values = 1'000'000};

/// A kind of experiment, which decides on the fields that it requires and may have.
enum class Kind : std::uint8_t { recording, loop, single_file };

/// An experiment that is being read. `recorded` has the file of a single file, too.
struct Draft : Experiment {
  Recording recorded;
};

Values pairs(const Values& items, std::string expected) {
  Values values = fields::lists(2, 2, items.rules);
  values.rules["x-expected"] = std::move(expected);
  return values;
}

Values coordinates() { return numbers(-kMaxCoordinateM, kMaxCoordinateM); }
Values places() { return pairs(coordinates(), "[x, y]"); }
Values polygons() { return lists(3, kMaxCorners, places().rules); }

/// Rejects the value at a path in an object or a list.
void reject(const json& value, const std::string& path, const std::string& expected,
            const FieldLocation& place) {
  place.below(path).reject(throng::describe(value.at(fields::pointer_below(path))), expected);
}

// Each read() stores a value that the rules of its field permit, and adds a problem where it breaks
// a rule that spans several values.

void read(const json& value, AlignedBox2d& box, const FieldLocation& place);
void read(const json& value, Loop& loop, const FieldLocation& place);
void read(const json& value, SingleFile& single, const FieldLocation& place);

/// A number or a point.
template <typename Value>
void read(const json& value, Value& object, const FieldLocation& /*place*/) {
  fields::set_value(value, object);
}

void read(const json& value, Corners& polygon, const FieldLocation& place) {
  for (const json& corner : value) fields::set_value(corner, polygon.emplace_back());
  if (geometry::is_simple(polygon)) return;
  place.reject(throng::describe(value),
               "corners in order, whose edges have a length and do not cross");
}

void read(const json& value, CountingLine& line, const FieldLocation& place) {
  fields::set_value(value[0], line.from);
  fields::set_value(value[1], line.to);
  if (line.length_m() >= kShortestM) return;
  place.reject(throng::describe(value), fmt::format("a line of {} m or more", kShortestM));
}

void read(const json& value, TimeRange& period, const FieldLocation& place) {
  period = {value[0], value[1]};
  if (period.until_s > period.from_s) return;
  reject(value, "1", "a time after the first one", place);
}

void read(const json& value, DensitySpeed& pair, const FieldLocation& /*place*/) {
  pair = {value[0], value[1]};
}

void read(const json& value, fs::path& file, const FieldLocation& place) {
  const auto& name = value.get_ref<const std::string&>();
  const fs::path folder = fs::path(place.source).parent_path();
  std::error_code ignored;
  file = folder / name;
  if (fs::is_regular_file(file, ignored)) return;
  std::vector<std::string> there;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    there.push_back(entry.path().filename().string());
  }
  std::sort(there.begin(), there.end());
  const std::vector<std::string_view> known(there.begin(), there.end());
  place.reject(throng::describe(value),
               fmt::format("a file in {}{}", folder.string(), did_you_mean(name, known)));
}

void read(const json& value, metrics::TrajectoryColumns& columns, const FieldLocation& place) {
  try {
    columns = metrics::columns_in_order(value);
  } catch (const InputError& error) {
    place.reject(throng::describe(value), error.problems().front().expected);
  }
}

template <typename Value>
void read(const json& value, std::vector<Value>& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    read(value[i], list.emplace_back(), place.below(i));
  }
}

template <typename Value>
void read(const json& value, std::optional<Value>& object, const FieldLocation& place) {
  read(value, object.emplace(), place);
}

template <typename Object, typename Access>
void add(FieldTable<Object>& table, const char* path, const char* unit, Values values,
         Access access, const char* help, bool is_required = true) {
  auto& field = table.add_read(
      path, std::move(values),
      [access](Object& object, const json& value, const FieldLocation& place) {
        read(value, access(object), place);
      },
      help);
  field.unit = unit;
  field.is_required = is_required;
}

/// Reads an object. Returns whether it is valid, so that rules that span its fields can be checked.
template <auto make_table, typename Object>
bool is_read(const json& value, Object& object, const FieldLocation& place) {
  static const FieldTable<Object> table = make_table();
  const std::size_t before = place.problems.size();
  table.read_checked(value, object, place);
  return place.problems.size() == before;
}

FieldTable<AlignedBox2d> box_fields() {
  FieldTable<AlignedBox2d> table;
  const auto min = [](AlignedBox2d& box) -> Vector2d& { return box.min(); };
  const auto max = [](AlignedBox2d& box) -> Vector2d& { return box.max(); };
  add(table, "min", "m", places(), min, "The corner with the smallest coordinates.");
  add(table, "max", "m", places(), max, "The corner with the greatest coordinates.");
  return table;
}

void read(const json& value, AlignedBox2d& box, const FieldLocation& place) {
  if (!is_read<box_fields>(value, box, place) || box.sizes().minCoeff() >= kShortestM) return;
  reject(value, "max", fmt::format("coordinates above those of min by {} m or more", kShortestM),
         place);
}

FieldTable<Loop> loop_fields() {
  FieldTable<Loop> table;
  add(table, "length_m", "m", numbers(1, 1000), at(&Loop::length_m),
      "Length along the middle; at least 2 π times the width.");
  add(table, "width_m", "m", numbers(0.5, 20), at(&Loop::width_m), "Width.");
  const Values pair = pairs(numbers(0, 10), "[density, speed]");
  add(table, "points", "1/m², m/s", lists(1, kMaxPoints, pair.rules), at(&Loop::recorded),
      "Densities and mean speeds.");
  return table;
}

void read(const json& value, Loop& loop, const FieldLocation& place) {
  if (!is_read<loop_fields>(value, loop, place)) return;
  if (loop.length_m < 2 * std::numbers::pi * loop.width_m) {
    reject(value, "length_m", fmt::format("at least 2 π times the width of {} m", loop.width_m),
           place);
  }
  for (std::size_t i = 0; i < loop.recorded.size(); ++i) {
    const double people = loop.recorded[i].density * loop.length_m * loop.width_m;
    if (people >= 1 && people <= kMaxPeople) continue;
    reject(value, fmt::format("points/{}/0", i),
           fmt::format("a density with 1 to {} people in the loop", kMaxPeople), place);
  }
}

FieldTable<SingleFile> single_file_fields() {
  FieldTable<SingleFile> table;
  add(table, "people", "", fields::integers(1, kMaxPeople), at(&SingleFile::people),
      "Number of people in the whole corridor.");
  add(table, "width_m", "m", numbers(0.5, 5), at(&SingleFile::width_m), "Width.");
  add(table, "from_x_m", "m", coordinates(), at(&SingleFile::from_x_m),
      "Begin of the part in which people are measured.");
  add(table, "until_x_m", "m", coordinates(), at(&SingleFile::until_x_m), "End of that part.");
  return table;
}

void read(const json& value, SingleFile& single, const FieldLocation& place) {
  if (!is_read<single_file_fields>(value, single, place)) return;
  if (single.until_x_m - single.from_x_m >= kShortestM) return;
  reject(value, "until_x_m", fmt::format("a number above from_x_m by {} or more", kShortestM),
         place);
}

void add_file(FieldTable<Draft>& table) {
  add(table, "file", "", fields::raw({{"type", "string"}}), at(&Draft::recorded, &Recording::file),
      "The recorded trajectories in a format that crowd.recorded of a job reads "
      "(docs/recorded.md), from this file's folder on; texts and tables may be compressed (.gz).");
  metrics::add_rate_and_unit(table, at(&Draft::recorded, &Recording::format));
  add(table, "columns", "", fields::texts(1, kMaxColumnsLength),
      at(&Draft::recorded, &Recording::format, &metrics::TrajectoryFormat::columns),
      "The columns of a text or table in their order, such as frame,id,x,y: id, frame or time, x, "
      "y, and - for others; default: what its first line or its numbers say.",
      /*is_required=*/false);
}

void add_speeds(FieldTable<Draft>& table) {
  const auto speeds = [](auto member) { return at(&Experiment::free_speeds, member); };
  constexpr const char* kHelp =
      "Speeds at which people walk alone: a normal distribution, truncated at three standard "
      "deviations and to the range of the mean.";
  table.group("free_speed_mps", "", kHelp).without_default();
  add(table, "free_speed_mps/mean", "m/s", numbers(FreeSpeeds::kMinMps, FreeSpeeds::kMaxMps),
      speeds(&FreeSpeeds::mean_mps), "Mean; without free_speed_mps 1.34.");
  add(table, "free_speed_mps/stddev", "m/s", numbers(0, 2), speeds(&FreeSpeeds::stddev_mps),
      "Standard deviation; without free_speed_mps 0.26.");
}

void add_recording(FieldTable<Draft>& table) {
  const auto part = [](auto member) { return at(&Draft::recorded, member); };
  const Values box = object_with(box_fields().schema());
  add(table, "walkable", "m", polygons(), part(&Recording::walkable),
      "Outline of the ground, corners in order whose edges do not cross: walls.");
  add(table, "obstacles", "m", lists(0, kMaxObstacles, polygons().rules),
      part(&Recording::obstacles), "Outlines of solid obstacles.", /*is_required=*/false);
  add(table, "goals", "m", lists(1, kMaxGoals, box.rules), part(&Recording::goals),
      "Destinations: one box along the axes for each stream, everybody's being that which their "
      "path approaches most.");
  add(table, "area", "m", box, part(&Recording::area),
      "Place of the measurement of density and speed: in a straight part of the way.");
  add(table, "line", "m", pairs(places(), "[[x, y], [x, y]]"), part(&Recording::line),
      "The line across the way at which people are counted.");
  add(table, "steady_s", "s", pairs(numbers(0, kMaxTimeS), "[from, until]"),
      part(&Recording::steady),
      "Period of the steady state, from the first frame on; default: from the 20th to the 80th "
      "percentile of the passages of the line.",
      /*is_required=*/false);
}

/// A recording has the fields of all kinds, so that a misspelled one is recognized.
FieldTable<Draft> make_fields(Kind kind) {
  FieldTable<Draft> table;
  add(table, "name", "", fields::names(kMaxNameLength), at(&Experiment::name),
      "A name of its own.");
  if (kind != Kind::loop) add_file(table);
  add_speeds(table);
  if (kind == Kind::recording) add_recording(table);
  if (kind != Kind::single_file) {
    add(table, "loop", "", object_with(loop_fields().schema()), at(&Experiment::loop),
        "People who walked around in a closed corridor, and how fast they were; the model walks in "
        "a ring of this size.",
        kind == Kind::loop);
  }
  if (kind != Kind::loop) {
    add(table, "single_file", "", object_with(single_file_fields().schema()),
        at(&Experiment::single_file),
        "People who walked around in single file, filmed in a straight part along x.",
        kind == Kind::single_file);
  }
  return table;
}

/// In the order of Kind.
const std::array<FieldTable<Draft>, 3>& tables() {
  static const std::array tables = {make_fields(Kind::recording), make_fields(Kind::loop),
                                    make_fields(Kind::single_file)};
  return tables;
}

/// The fields of all kinds, and those that one of the kinds requires.
ordered_json experiment_rules() {
  ordered_json rules = {{"title", "Experiment"}};
  rules.update(object_with(tables()[0].schema()).rules);
  rules["required"] = ordered_json::array({"name"});
  for (const FieldTable<Draft>& table : tables()) {
    rules["anyOf"].push_back({{"required", table.schema()["required"]}});
  }
  return rules;
}

/// Demands that people walk through the places of a recording.
void check_places(const Recording& recording, const json& value, const FieldLocation& place) {
  const Corners& ground = recording.walkable;
  if (ground.empty() || place.has_problem("walkable")) return;
  const auto demand = [&](const std::string& path, const geometry::Region& region) {
    if (place.has_problem(path) || geometry::touch(ground, region.corners())) return;
    reject(value, path, "a place that touches the walkable ground", place);
  };
  for (std::size_t i = 0; i < recording.goals.size(); ++i) {
    const AlignedBox2d& goal = recording.goals[i];
    demand(fmt::format("goals/{}", i), {{goal.min(), goal.max()}});
  }
  demand("area", {{recording.area.min(), recording.area.max()}});
  demand("line", {{}, {recording.line.from, recording.line.to}});
}

Experiment read_experiment(const json& value, const FieldLocation& place) {
  const Kind kind = value.contains("loop")          ? Kind::loop
                    : value.contains("single_file") ? Kind::single_file
                                                    : Kind::recording;
  Draft draft;
  tables().at(static_cast<std::size_t>(kind)).read_checked(value, draft, place);
  if (kind == Kind::recording) {
    check_places(draft.recorded, value, place);
    draft.recording = std::move(draft.recorded);
  } else if (draft.single_file) {
    draft.single_file->file = std::move(draft.recorded.file);
    draft.single_file->format = std::move(draft.recorded.format);
  }
  return draft;
}

void set_experiments(Experiments& experiments, const json& value, const FieldLocation& place) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < value.size(); ++i) {
    experiments.push_back(read_experiment(value[i], place.below(i)));
    const std::string& name = experiments.back().name;
    if (name.empty() || names.insert(name).second) continue;
    reject(value, fmt::format("{}/name", i), "a name that no other experiment has", place);
  }
}

FieldTable<Experiments> document_fields() {
  FieldTable<Experiments> table;
  table.add_schema_name();
  table
      .add_read("experiments", lists(1, kMaxExperiments, experiment_rules()), set_experiments,
                "Each has either the fields of a recording (file, walkable, goals, area, line), "
                "loop, or file and single_file.")
      .required();
  return table;
}

}  // namespace

std::vector<Experiment> parse_experiments(std::string_view text, const fs::path& folder) {
  const std::string source = (folder / "experiments.json").string();
  const json document = parse_json(text, source, kLimits);
  Experiments experiments;
  std::vector<Problem> problems;
  document_fields().read_checked(document, experiments, {"", source, problems});
  if (!problems.empty()) throw InputError(std::move(problems));
  return experiments;
}

ordered_json experiments_schema() {
  return fields::document_schema("throng experiments",
                                 "Recorded people that throng validate-crowd --data compares "
                                 "models with (docs/validation.md).",
                                 document_fields().schema());
}

}  // namespace throng::validation
