#include "spec/job/recorded_spec.h"

#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>

#include "spec/metrics/format_fields.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr const char* kRecordedFolder = "recorded";
/// In the order of metrics::TrajectoryKind.
constexpr std::array kKindWords = {"any", "text", "sqlite", "scb", "csv", "hdf5", "fcd", "json"};

json file_json(const RecordedSpec& spec) {
  return fmt::format("{}/{}", kRecordedFolder, spec.file.filename().string());
}

void set_file(RecordedSpec& spec, const json& value, const FieldLocation& place) {
  const auto name = value.get<std::string>();
  if (place.source.empty()) {
    place.problems.push_back({"", place.pointer, fmt::format("\"{}\"", name),
                              "a job file, since a request has no files beside it"});
    return;
  }
  spec.file = std::filesystem::path(place.source).parent_path() / name;
}

/// A table says when by its frames or by times.
void set_time_column(RecordedSpec& spec, const json& value, const FieldLocation& /*place*/) {
  value.get_to(spec.format.columns.time);
  spec.format.columns.frame.clear();
}

void add_file_fields(FieldTable<RecordedSpec>& table) {
  table
      .add("file", "File", "", texts(1, 1000), file_json, set_file,
           "The file of trajectories, named from the job's folder; a job's own folder keeps a "
           "copy. Requests cannot name files.")
      .required();
  table
      .add(
          "sha256", "Hash", "", texts_like("^[0-9a-f]{64}$", "64 hexadecimal digits"),
          [](const RecordedSpec& spec) { return json(spec.sha256); },
          [](RecordedSpec& spec, const json& value, const FieldLocation&) {
            value.get_to(spec.sha256);
          },
          "SHA-256 of the file; another file is refused. Filled in.")
      .without_default();
  table
      .add_word("format", "Format", kKindWords,
                at(&RecordedSpec::format, &metrics::TrajectoryFormat::kind),
                "text or csv, a table whose columns may be named below; JuPedSim's sqlite, Menge's "
                "scb, the Data Archive's hdf5, SUMO's fcd, json of Pathfinder or TrajNet++; "
                "without it (any), "
                "by suffix and content.")
      .without_default();
  metrics::add_rate_and_unit(table, at(&RecordedSpec::format));
}

void add_column_fields(FieldTable<RecordedSpec>& table) {
  table
      .group("columns", "Columns",
             "Names of the columns of a table in its first line, or all of their numbers from 1.")
      .without_default();
  table
      .add("columns/person", "Person", "", texts(1, 200),
           at(&RecordedSpec::format, &metrics::TrajectoryFormat::columns,
              &metrics::TrajectoryColumns::person),
           "Name or number of the person; default: id.")
      .without_default();
  table
      .add("columns/frame", "Frame", "", texts(1, 200),
           at(&RecordedSpec::format, &metrics::TrajectoryFormat::columns,
              &metrics::TrajectoryColumns::frame),
           "Number of the frame; default: frame.")
      .without_default();
  table
      .add(
          "columns/time", "Time", "", texts(1, 200),
          [](const RecordedSpec& spec) { return value_json(spec.format.columns.time); },
          set_time_column, "Time in seconds, instead of frame.")
      .without_default();
  table
      .add("columns/x", "x", "", texts(1, 200),
           at(&RecordedSpec::format, &metrics::TrajectoryFormat::columns,
              &metrics::TrajectoryColumns::x),
           "Position along x; default: x.")
      .without_default();
  table
      .add("columns/y", "y", "", texts(1, 200),
           at(&RecordedSpec::format, &metrics::TrajectoryFormat::columns,
              &metrics::TrajectoryColumns::y),
           "Position along y; default: y.")
      .without_default();
}

void add_walker_fields(FieldTable<RecordedSpec>& table) {
  table
      .add("radius_m", "Radius", "m", numbers(0.05, 2),
           at(&RecordedSpec::walkers, &metrics::WalkerDefaults::radius_m),
           "Radius of all bodies, which files do not contain; default: 0.2.")
      .without_default();
  table
      .add("desired_speed_mps", "Desired speed", "m/s", numbers(0.1, 20),
           at(&RecordedSpec::walkers, &metrics::WalkerDefaults::desired_speed_mps),
           "Preferred speed of all people, for the metrics; default: 1.34.")
      .without_default();
}

FieldTable<RecordedSpec> make_recorded_fields() {
  FieldTable<RecordedSpec> table;
  add_file_fields(table);
  add_column_fields(table);
  add_walker_fields(table);
  return table;
}

}  // namespace

const FieldTable<RecordedSpec>& recorded_fields() {
  static const FieldTable<RecordedSpec> table = make_recorded_fields();
  return table;
}

RecordedSpec read_recorded(const json& value, const FieldLocation& place) {
  RecordedSpec recorded;
  recorded_fields().read(value, recorded, place);
  if (value_at(value, "columns/time") != nullptr && value_at(value, "columns/frame") != nullptr) {
    place.problems.push_back({"", place.pointer + "/columns/frame",
                              "a column of frames beside one of times", "only one of them"});
  }
  return recorded;
}

json to_json(const RecordedSpec& recorded) { return recorded_fields().print(recorded); }

std::filesystem::path kept_recording(const RecordedSpec& recorded,
                                     const std::filesystem::path& job_folder) {
  return job_folder / kRecordedFolder / recorded.file.filename();
}

}  // namespace throng::jobs
