// experiments.json: how users describe recorded experiments.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "base/error.h"
#include "base/geometry/polygon.h"
#include "base/json/json_text.h"
#include "base/schemas/schemas.h"
#include "base/text/suggest.h"
#include "crowd/validation/experiments/experiment.h"
#include "world/json_reader.h"

namespace throng::validation {

namespace fs = std::filesystem;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using world::JsonValue;

namespace {

constexpr std::size_t kMaxExperiments = 1000;
constexpr std::size_t kMaxCorners = 1000;
constexpr std::size_t kMaxGoals = 20;
constexpr std::size_t kMaxPoints = 100;
constexpr std::size_t kMaxNameLength = 100;
constexpr double kMaxCoordinateM = 500;
constexpr double kMaxTimeS = 7200;
constexpr double kShortestM = 0.1;
constexpr int kMaxPeople = 10'000;
constexpr JsonLimits kLimits = {.max_bytes = 16 << 20, .max_values = 1'000'000};

std::vector<JsonValue> items_up_to(const JsonValue& value, std::size_t at_least,
                                   std::size_t at_most) {
  std::vector<JsonValue> items = value.items(at_least);
  if (items.size() <= at_most) return items;
  value.reject(fmt::format("at most {} elements", at_most));
  return {};
}

/// An empty polygon if it is wrong.
Polygon polygon(const JsonValue& value) {
  constexpr std::size_t kMinCorners = 3;
  Polygon corners;
  for (const JsonValue& corner : items_up_to(value, kMinCorners, kMaxCorners)) {
    corners.push_back(corner.vector2(kMaxCoordinateM));
  }
  if (corners.empty() || geometry::is_simple(corners)) return corners;
  value.reject("corners in order, whose edges have a length and do not cross");
  return {};
}

AlignedBox2d read_box(const JsonValue& value) {
  value.fields({"min", "max"});
  const Vector2d min = value["min"].vector2(kMaxCoordinateM);
  const Vector2d max = value["max"].vector2(kMaxCoordinateM);
  if (value["min"].is_list_of(2) && value["max"].is_list_of(2) &&
      (max - min).minCoeff() < kShortestM) {
    value["max"].reject(fmt::format("coordinates above those of min by {} m or more", kShortestM));
  }
  return {min, max};
}

CountingLine read_line(const JsonValue& value) {
  const auto ends = value.tuple(2, "[[x, y], [x, y]]");
  if (ends.empty()) return {Vector2d::Zero(), Vector2d::Zero()};
  const CountingLine line{ends[0].vector2(kMaxCoordinateM), ends[1].vector2(kMaxCoordinateM)};
  if (line.length_m() < kShortestM) {
    value.reject(fmt::format("a line of {} m or more", kShortestM));
  }
  return line;
}

/// Whether a polyline comes to the ground, be it only to its outline.
bool touches(const Polygon& ground, const Polygon& path) {
  constexpr double kRoundingM = 1e-9;
  const auto is_on = [&](const Vector2d& p) {
    return geometry::signed_distance_to(ground, p) <= kRoundingM;
  };
  if (std::any_of(path.begin(), path.end(), is_on)) return true;
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (std::size_t j = 0; j < ground.size(); ++j) {
      const Vector2d& next = ground[(j + 1) % ground.size()];
      if (geometry::segments_cross(path[i - 1], path[i], ground[j], next)) return true;
    }
  }
  return false;
}

bool touches(const Polygon& ground, const AlignedBox2d& box) {
  using Corner = AlignedBox2d::CornerType;
  const Polygon outline = {box.corner(Corner::BottomLeft), box.corner(Corner::BottomRight),
                           box.corner(Corner::TopRight), box.corner(Corner::TopLeft),
                           box.corner(Corner::BottomLeft)};
  return touches(ground, outline) || box.contains(ground.front());
}

class ExperimentsReader {
 public:
  ExperimentsReader(const nlohmann::json& document, const std::string& source,
                    const fs::path& folder)
      : document_(document), source_(source), folder_(folder), root_(document, source, problems_) {}

  std::vector<Experiment> read() {
    root_.fields({"experiments"});
    std::vector<Experiment> experiments;
    for (const JsonValue& item : items_up_to(root_["experiments"], 1, kMaxExperiments)) {
      experiments.push_back(read_experiment(item));
    }
    schemas::add_schema_problems(schemas::Kind::experiments, document_, source_, problems_);
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return experiments;
  }

 private:
  Experiment read_experiment(const JsonValue& item) {
    Experiment experiment;
    if (item["loop"].exists()) {
      item.fields({"name", "loop"}, {"free_speed_mps"});
      experiment.loop = read_loop(item["loop"]);
    } else if (item["single_file"].exists()) {
      item.fields({"name", "file", "single_file"},
                  {"columns", "frame_rate_hz", "unit", "free_speed_mps"});
      experiment.single_file = read_single_file(item);
    } else {
      item.fields({"name", "file", "walkable", "goals", "area", "line"},
                  {"columns", "frame_rate_hz", "unit", "free_speed_mps", "obstacles", "steady_s",
                   "loop", "single_file"});
      experiment.recording = read_recording(item);
    }
    experiment.name = read_name(item["name"]);
    if (const JsonValue speeds = item["free_speed_mps"]; speeds.exists()) {
      speeds.fields({"mean", "stddev"});
      experiment.free_speeds = {speeds["mean"].number(0.3, 2.5), speeds["stddev"].number(0, 2)};
    }
    return experiment;
  }

  std::string read_name(const JsonValue& value) {
    std::string name = value.identifier();
    if (name.size() > kMaxNameLength) {
      value.reject(fmt::format("at most {} characters", kMaxNameLength));
    } else if (!name.empty() && !names_.insert(name).second) {
      value.reject("a name that no other experiment has");
    }
    return name;
  }

  fs::path read_file_name(const JsonValue& value) const {
    const std::string name = value.text();
    const fs::path file = folder_ / name;
    std::error_code ignored;
    if (!value.is_text() || fs::is_regular_file(file, ignored)) return file;
    std::vector<std::string> there;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
      there.push_back(entry.path().filename().string());
    }
    std::sort(there.begin(), there.end());
    const std::vector<std::string_view> known(there.begin(), there.end());
    value.reject(fmt::format("a file in {}{}", folder_.string(), did_you_mean(name, known)));
    return file;
  }

  static metrics::TrajectoryFormat read_format(const JsonValue& item) {
    metrics::TrajectoryFormat format;
    if (item["frame_rate_hz"].exists()) {
      format.frames_per_s = item["frame_rate_hz"].number(0.01, 10'000);
    }
    if (const JsonValue columns = item["columns"]; columns.is_text()) {
      try {
        format.columns = metrics::columns_in_order(columns.text());
      } catch (const InputError& error) {
        columns.reject(error.problems().front().expected);
      }
    }
    const JsonValue unit = item["unit"];
    if (!unit.exists()) return format;
    const std::string word = unit.text();
    for (const metrics::LengthUnit& known : metrics::kLengthUnits) {
      if (word == known.word) format.unit_m = known.meters;
    }
    if (unit.is_text() && !format.unit_m) unit.reject("\"m\", \"cm\", \"mm\" or \"ft\"");
    return format;
  }

  Recording read_recording(const JsonValue& item) const {
    Recording recording;
    recording.file = read_file_name(item["file"]);
    recording.format = read_format(item);
    recording.walkable = polygon(item["walkable"]);
    for (const JsonValue& obstacle : items_up_to(item["obstacles"], 0, kMaxCorners)) {
      recording.obstacles.push_back(polygon(obstacle));
    }
    const auto goals = items_up_to(item["goals"], 1, kMaxGoals);
    for (const JsonValue& goal : goals) recording.goals.push_back(read_box(goal));
    recording.area = read_box(item["area"]);
    recording.line = read_line(item["line"]);
    if (item["steady_s"].exists()) recording.steady = read_period(item["steady_s"]);
    if (recording.walkable.empty()) return recording;
    const auto demand = [](bool holds, const JsonValue& value) {
      if (!holds) value.reject("a place that touches the walkable ground");
    };
    for (std::size_t i = 0; i < goals.size(); ++i) {
      demand(touches(recording.walkable, recording.goals[i]), goals[i]);
    }
    demand(touches(recording.walkable, recording.area), item["area"]);
    demand(touches(recording.walkable, Polygon{recording.line.from, recording.line.to}),
           item["line"]);
    return recording;
  }

  static TimeRange read_period(const JsonValue& value) {
    const auto ends = value.tuple(2, "[from, until]");
    if (ends.empty()) return {};
    const TimeRange period{ends[0].number(0, kMaxTimeS), ends[1].number(0, kMaxTimeS)};
    if (ends[0].is_number() && ends[1].is_number() && period.until_s <= period.from_s) {
      ends[1].reject("a time after the first one");
    }
    return period;
  }

  static Loop read_loop(const JsonValue& value) {
    value.fields({"length_m", "width_m", "points"});
    Loop loop{value["length_m"].number(1, 1000), value["width_m"].number(0.5, 20), {}};
    if (loop.length_m < 2 * std::numbers::pi * loop.width_m) {
      value["length_m"].reject(fmt::format("at least 2 π times the width of {} m", loop.width_m));
    }
    for (const JsonValue& point : items_up_to(value["points"], 1, kMaxPoints)) {
      const auto numbers = point.tuple(2, "[density, speed]");
      if (numbers.empty()) continue;
      const DensitySpeed pair{numbers[0].number(0, 10), numbers[1].number(0, 10)};
      const double people = pair.density * loop.length_m * loop.width_m;
      if (numbers[0].is_number() && (people < 1 || people > kMaxPeople)) {
        numbers[0].reject(fmt::format("a density with 1 to {} people in the loop", kMaxPeople));
      }
      loop.recorded.push_back(pair);
    }
    return loop;
  }

  SingleFile read_single_file(const JsonValue& item) const {
    const JsonValue value = item["single_file"];
    value.fields({"people", "width_m", "from_x_m", "until_x_m"});
    SingleFile single{read_file_name(item["file"]),
                      read_format(item),
                      static_cast<std::size_t>(value["people"].integer(1, kMaxPeople)),
                      value["width_m"].number(0.5, 5),
                      value["from_x_m"].number(-kMaxCoordinateM, kMaxCoordinateM),
                      value["until_x_m"].number(-kMaxCoordinateM, kMaxCoordinateM)};
    if (value["from_x_m"].exists() && single.until_x_m - single.from_x_m < kShortestM) {
      value["until_x_m"].reject(fmt::format("a number above from_x_m by {} or more", kShortestM));
    }
    return single;
  }

  const nlohmann::json& document_;
  const std::string& source_;
  const fs::path& folder_;
  std::vector<Problem> problems_;
  JsonValue root_;
  std::set<std::string> names_;
};

}  // namespace

std::vector<Experiment> parse_experiments(std::string_view text, const fs::path& folder) {
  const std::string source = (folder / "experiments.json").string();
  const nlohmann::json document = parse_json(text, source, kLimits);
  return ExperimentsReader(document, source, folder).read();
}

}  // namespace throng::validation
