#include "jobs/spec/recorded_spec.h"

#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr const char* kRecordedFolder = "recorded";
constexpr const char* kRecordedPointer = "/crowd/recorded";
/// In the order of metrics::TrajectoryKind.
constexpr std::array kKindWords = {"any", "text", "sqlite", "scb", "csv"};

struct LengthUnit {
  const char* word;
  double metres;
};
constexpr std::array<LengthUnit, 4> kLengthUnits = {
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}}};

metrics::TrajectoryFormat format_of(const json& value, std::vector<Problem>& problems) {
  metrics::TrajectoryFormat format;
  const std::string kind = value.value("format", kKindWords[0]);
  for (std::size_t i = 0; i < kKindWords.size(); ++i) {
    if (kind == kKindWords[i]) format.kind = static_cast<metrics::TrajectoryKind>(i);
  }
  if (value.contains("frame_rate_hz")) format.frames_per_s = value["frame_rate_hz"].get<double>();
  for (const LengthUnit& unit : kLengthUnits) {
    if (value.value("unit", "") == unit.word) format.unit_m = unit.metres;
  }
  if (!value.contains("columns")) return format;
  const json& columns = value["columns"];
  format.columns.person = columns.value("person", format.columns.person);
  format.columns.x = columns.value("x", format.columns.x);
  format.columns.y = columns.value("y", format.columns.y);
  format.columns.time = columns.value("time", "");
  if (!format.columns.time.empty()) format.columns.frame.clear();
  if (columns.contains("frame")) {
    if (!format.columns.time.empty()) {
      problems.push_back({"", fmt::format("{}/columns/frame", kRecordedPointer),
                          "a column of frames beside one of times", "only one of them"});
    }
    format.columns.frame = columns["frame"].get<std::string>();
  }
  return format;
}

}  // namespace

std::optional<RecordedSpec> read_recorded(const json& crowd, const std::string& source,
                                          std::vector<Problem>& problems) {
  const auto found = crowd.find("recorded");
  if (found == crowd.end()) return std::nullopt;
  RecordedSpec recorded;
  recorded.format = format_of(*found, problems);
  recorded.walkers.radius_m = found->value("radius_m", recorded.walkers.radius_m);
  recorded.walkers.desired_speed_mps =
      found->value("desired_speed_mps", recorded.walkers.desired_speed_mps);
  const auto name = found->at("file").get<std::string>();
  const std::string pointer = fmt::format("{}/file", kRecordedPointer);
  if (source.empty()) {
    problems.push_back({"", pointer, fmt::format("\"{}\"", name),
                        "a job file, since a request has no files beside it"});
    return recorded;
  }
  recorded.file = std::filesystem::path(source).parent_path() / name;
  recorded.sha256 = found->value("sha256", "");
  return recorded;
}

json to_json(const RecordedSpec& recorded) {
  const metrics::TrajectoryFormat& format = recorded.format;
  json value = {
      {"file", fmt::format("{}/{}", kRecordedFolder, recorded.file.filename().string())},
      {"sha256", recorded.sha256},
      {"format", kKindWords[static_cast<std::size_t>(format.kind)]},
      {"columns",
       {{"person", format.columns.person}, {"x", format.columns.x}, {"y", format.columns.y}}},
      {"radius_m", recorded.walkers.radius_m},
      {"desired_speed_mps", recorded.walkers.desired_speed_mps}};
  if (format.frames_per_s) value["frame_rate_hz"] = *format.frames_per_s;
  for (const LengthUnit& unit : kLengthUnits) {
    if (format.unit_m == unit.metres) value["unit"] = unit.word;
  }
  const bool by_time = !format.columns.time.empty();
  value["columns"][by_time ? "time" : "frame"] =
      by_time ? format.columns.time : format.columns.frame;
  return value;
}

std::filesystem::path kept_recording(const RecordedSpec& recorded,
                                     const std::filesystem::path& job_folder) {
  return job_folder / kRecordedFolder / recorded.file.filename();
}

}  // namespace throng::jobs
