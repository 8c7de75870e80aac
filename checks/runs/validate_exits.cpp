// Exits: table, records of images and polygons. Definitions: docs/metrics.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "base/json/json_text.h"
#include "checks/run_checks.h"
#include "checks/shares.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/run_trajectories.h"
#include "spec/annotate/table_columns.h"

namespace throng::checks {

using Eigen::Vector2d;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

/// Position of a point of the image, in box coordinates, on the ground.
std::optional<Vector2d> on_ground(const camera::Camera& camera, const Vector2d& point) {
  const Vector3d at = camera.unproject(point.array() - 0.5, 1);
  const Vector3d center = camera.pose.center();
  const double down = center.z() - at.z();
  if (!at.allFinite() || !(down > 1e-6)) return std::nullopt;
  return Vector2d((center + (at - center) * (center.z() / down)).head<2>());
}

/// The greatest distance between two points.
double diameter(const std::vector<Vector2d>& points) {
  double max_m = 0;
  for (const Vector2d& a : points) {
    for (const Vector2d& b : points) max_m = std::max(max_m, (a - b).norm());
  }
  return max_m;
}

Vector2d point_at(const json& point) {
  return {point.at(0).get<double>(), point.at(1).get<double>()};
}

}  // namespace

/// Empty where the ground is nowhere near, or the polygon is cut off by the camera's plane or the
/// end of its lens.
ExitsCheck::Outline ExitsCheck::exit_outline(const camera::Camera& camera, const json& polygon) {
  Outline outline;
  for (const json& written : polygon) {
    const Vector2d point = point_at(written);
    const auto corner = on_ground(camera, point);
    if (!corner) return {};
    constexpr double kCutM = 0.2;  // the polygon may be cut off
    if (!(camera.project({corner->x(), corner->y(), 0}).depth_m > kCutM)) return {};
    std::array<Vector2d, 4> rounding;
    constexpr double kRoundingPx = 0.01;  // twice, so that it leaves the lens where that cuts
    for (std::size_t i = 0; i < rounding.size(); ++i) {
      const Vector2d off((i & 1U) != 0 ? kRoundingPx : -kRoundingPx,
                         (i & 2U) != 0 ? kRoundingPx : -kRoundingPx);
      const auto moved = on_ground(camera, point + off);
      if (!moved) return {};
      rounding.at(i) = *moved;
      outline.rounding_m = std::max(outline.rounding_m, (*moved - *corner).norm());
    }
    outline.corners.push_back(*corner);
    outline.rounding.push_back(rounding);
  }
  return outline;
}

/// How far a corner of the polygon is, at most, from where the place's is seen, less what the
/// rounding of that explains.
double ExitsCheck::max_corner_distance_px(const camera::Camera& camera, const Outline& place,
                                          const json& polygon) {
  const auto seen_at = [&](const Vector2d& at) { return camera.project({at.x(), at.y(), 0}); };
  double off_px = 0;
  for (std::size_t i = 0; i < place.corners.size(); ++i) {
    const auto seen = seen_at(place.corners[i]);
    if (!seen.visible) return 0;
    double rounding_px = 0;
    for (const Vector2d& moved : place.rounding[i]) {
      const auto other = seen_at(moved);
      if (!other.visible) return 0;
      rounding_px = std::max(rounding_px, (other.pixel - seen.pixel).norm());
    }
    const Vector2d here = seen.pixel.array() + 0.5;
    off_px = std::max(off_px, (point_at(polygon.at(i)) - here).norm() - rounding_px);
  }
  return off_px;
}

ExitsCheck::Run& ExitsCheck::read(const formats::DatasetInfo& info, const std::string& name,
                                  Findings& findings) {
  const auto [entry, is_new] = runs_.try_emplace(name);
  Run& run = entry->second;
  const std::string file = "exits/" + name + ".csv";
  if (!is_new || !std::filesystem::is_regular_file(info.root / file)) return run;
  const formats::CsvTable table = formats::read_csv(info.root / file);
  if (fmt::format("{}", fmt::join(table.columns, ",")) != annotate::kExitColumns) {
    findings.add("exits", file, "line 1", "other columns than docs/formats_pixels.md has");
  }
  const auto column = [&](const char* wanted) {
    const std::size_t found = table.find(wanted);
    if (found == table.columns.size()) {
      throw InputError({(info.root / file).string(), "line 1", fmt::format("no column {}", wanted),
                        "the columns of docs/formats.md"});
    }
    return found;
  };
  const std::size_t frame = column("frame");
  const std::size_t exit = column("exit");
  const std::size_t state = column("state");
  const std::size_t offline = column("state_offline");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<std::string>& cells = table.rows[i];
    ExitRow row{i + 2, {}, cells[state], cells[offline]};
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const double value = formats::parse_number(cells[c]);
      if (c != exit && c != state && c != offline && !std::isfinite(value)) {
        findings.add("exits", file, fmt::format("line {}", i + 2),
                     fmt::format("{} is no number: {}", table.columns[c], cells[c]));
      }
      row.value[table.columns[c]] = value;
    }
    const auto number = static_cast<std::int64_t>(formats::parse_number(cells[frame]));
    if (!run.exits.contains(cells[exit])) run.order.push_back(cells[exit]);
    const double time_s = info.from_s + static_cast<double>(number) / info.rate_hz;
    if (!(std::abs(row["time_s"] - time_s) <= 1e-6)) {
      findings.add(
          "exits", file, fmt::format("line {}", i + 2),
          fmt::format("time_s {}, but frame {} is of {} s", row["time_s"], number, time_s));
    }
    if (!run.exits[cells[exit]].emplace(number, std::move(row)).second) {
      findings.add("exits", file, fmt::format("line {}", i + 2),
                   "a frame and exit that come twice");
    }
  }
  for (const auto& [id, series] : run.exits) {
    if (static_cast<std::int64_t>(series.size()) != info.frames_per_camera) {
      findings.add(
          "exits", file, id,
          fmt::format("{} rows, but there are {} frames", series.size(), info.frames_per_camera));
    }
    check_exit_series(file, id, series, findings);
  }
  return run;
}

void ExitsCheck::check_values(const std::string& file, const formats::Image& image,
                              const json& exit, const Run& run, Findings& findings) {
  const std::string id = exit.at("id");
  const std::string record = fmt::format("image {}", image.id);
  const auto series = run.exits.find(id);
  if (series == run.exits.end() || !series->second.contains(image.frame)) {
    findings.add("exits", formats::kCocoFile, record,
                 fmt::format("exit {} is not in {} for frame {}", id, file, image.frame));
    return;
  }
  const ExitRow& row = series->second.at(image.frame);
  struct Pair {
    const char* key;
    const char* column;
    double slack;
  };
  for (const Pair& pair :
       {Pair{"in_zone", "in_zone", 0}, Pair{"queue", "queue", 0},
        Pair{"queue_length_m", "queue_length", 1e-6},
        Pair{"clogging_index", "clogging_index", 1e-6}, Pair{"flow_per_s", "flow", 1e-6}}) {
    if (!exit.contains(pair.key)) continue;
    const double found = exit.at(pair.key).get<double>();
    const double expected = row[pair.column];
    if (!std::isfinite(expected) || std::abs(found - expected) <= pair.slack) continue;
    findings.add("exits", formats::kCocoFile, record,
                 fmt::format("{} of {} is {}, but {} line {} says {}", pair.key, id, found, file,
                             row.line, expected));
  }
  if (exit.at("state") != row.state) {
    findings.add("exits", formats::kCocoFile, record,
                 fmt::format("state of {} is {}, but {} line {} says {}", id,
                             exit.at("state").dump(), file, row.line, row.state));
  }
}

void ExitsCheck::check_polygons(const formats::Image& image, const json& exit, Findings& findings) {
  const auto id = exit.at("id").get<std::string>();
  const camera::Camera camera = formats::image_camera(image);
  ExitOutlines& place = places_[{image.scenario(), id}];
  for (const char* key : {"door", "zone"}) {
    const json& polygon = exit.at(key);
    if (polygon.empty()) continue;
    Outline& known = key[0] == 'd' ? place.door : place.zone;
    Outline outline = exit_outline(camera, polygon);
    if (outline.corners.empty()) continue;
    const bool is_new = known.corners.empty();
    const double off_px = is_new || known.corners.size() != polygon.size()
                              ? 0
                              : max_corner_distance_px(camera, known, polygon);
    if (is_new || outline.rounding_m < known.rounding_m) known = std::move(outline);
    // The lens is inverted numerically.
    constexpr double kSlackPx = 0.5;
    if (off_px <= kSlackPx) continue;
    findings.add(
        "exit-polygons", formats::kCocoFile, fmt::format("image {}", image.id),
        fmt::format("{} of {} is {:.1f} px from where other images have it", key, id, off_px));
  }
  const std::string fault = shape_fault(id, place);
  if (fault.empty()) return;
  findings.add("exit-polygons", formats::kCocoFile, fmt::format("image {}", image.id), fault);
}

/// The door is a strip 0.5 m deep, and the zone a half disc about its middle. "" if they are.
std::string ExitsCheck::shape_fault(const std::string& id, const ExitOutlines& place) {
  const std::vector<Vector2d>& door = place.door.corners;
  const std::vector<Vector2d>& zone = place.zone.corners;
  if (door.size() < 4 || zone.size() < 3) return "";
  const double door_m = diameter(door);
  const double depth_m = std::abs(geometry::signed_area(door)) / std::max(door_m, 0.1);
  constexpr double kMaxDepthM = 0.75;
  if (depth_m > kMaxDepthM + 2 * place.door.rounding_m) {
    return fmt::format("the door of {} is {:.1f} m long and {:.1f} m deep, expected 0.5 m", id,
                       door_m, depth_m);
  }
  const double zone_m = diameter(zone);
  constexpr double kDoorDepthM = 0.5;
  const double width_m = std::sqrt(std::max(0.0, door_m * door_m - kDoorDepthM * kDoorDepthM));
  const double expected_m = 2 * (std::max(width_m, 2.0) + 1);
  Vector2d door_middle = Vector2d::Zero();
  for (const Vector2d& corner : door) door_middle += corner / static_cast<double>(door.size());
  double reach_m = 0;
  for (const Vector2d& corner : zone) reach_m = std::max(reach_m, (corner - door_middle).norm());
  // Cut off by the camera's plane, they are smaller.
  const double slack_m =
      0.25 + 0.05 * expected_m + 2 * (place.door.rounding_m + place.zone.rounding_m);
  if (zone_m <= expected_m + slack_m && reach_m <= 0.5 * expected_m + 0.5 + slack_m) return "";
  return fmt::format(
      "the zone of {} is {:.1f} m wide and reaches {:.1f} m from the door's middle, but the door "
      "is "
      "{:.1f} m wide",
      id, zone_m, reach_m, width_m);
}

void ExitsCheck::count_people(const std::string& file, const formats::Image& image, Run& run,
                              Findings& findings) const {
  std::set<std::int64_t>& counted = run.counted[image.frame];
  run.scenario = image.scenario();
  for (const formats::Person& person : image.people) {
    const auto exit = person.record.find("exit");
    run.headed[image.frame][person.track_id] = person.record.value("exit", "");
    if (exit == person.record.end()) continue;
    const std::string id = *exit;
    if (!run.exits.contains(id)) {
      findings.add("exits", person, "exit is none of the scenario's: " + id);
      continue;
    }
    run.wanted[person.track_id] = id;
    const auto place = places_.find({image.scenario(), id});
    if (place == places_.end() || place->second.zone.corners.empty()) continue;
    if (!counted.insert(person.track_id).second) continue;
    // Well inside: the table is of the last crowd step before the frame.
    const std::vector<Vector2d>& zone = place->second.zone.corners;
    bool is_inside = true;
    for (std::size_t i = 0; i < zone.size(); ++i) {
      const Vector2d side = zone[(i + 1) % zone.size()] - zone[i];
      const Vector2d to = person.position.head<2>() - zone[i];
      if (side.norm() < 1e-6) continue;
      const double margin_m = 0.4 + place->second.zone.rounding_m;
      is_inside = is_inside && geometry::cross(side, to) / side.norm() > margin_m;
    }
    if (!is_inside) continue;
    const int found = ++run.in_zone[image.frame][id];
    const auto row = run.exits.at(id).find(image.frame);
    if (row == run.exits.at(id).end()) continue;
    if (found > row->second["in_zone"]) {
      findings.add("exits", file, fmt::format("line {}", row->second.line),
                   fmt::format("{}: in_zone {}, but images show {} there who head for it", id,
                               row->second["in_zone"], found));
    }
  }
}

/// As many people as the table has in a zone may be there: those who head for the exit by their
/// records, and those whom no image shows.
void ExitsCheck::count_everybody(const formats::DatasetInfo& info, const std::string& name,
                                 const Run& run, Findings& findings) const {
  const formats::RunTrajectories recorded = formats::read_run_trajectories(info.root, name);
  for (const auto& [id, series] : run.exits) {
    const auto place = places_.find({run.scenario, id});
    if (place == places_.end() || place->second.zone.corners.size() < 3) continue;
    // The table is of the last crowd step before the frame, half a second at most.
    const double margin_m = 1.5 + place->second.zone.rounding_m;
    for (const auto& [frame, row] : series) {
      const auto number = static_cast<std::size_t>(frame);
      const auto headed = run.headed.find(frame);
      int may_be = 0;
      for (std::size_t i = 0; number < recorded.times_s.size() && i < recorded.tracks.size(); ++i) {
        if (!recorded.present(number, i) ||
            geometry::signed_distance_to(place->second.zone.corners, recorded.place(number, i)) >
                margin_m) {
          continue;
        }
        const auto* records = headed == run.headed.end() ? nullptr : &headed->second;
        const bool is_seen = records != nullptr && records->contains(recorded.tracks[i]);
        may_be += !is_seen || records->at(recorded.tracks[i]) == id ? 1 : 0;
      }
      if (row["in_zone"] <= may_be) continue;
      findings.add("exits", ground_truth_file(annotate::GroundTruth::exits, name),
                   fmt::format("line {}", row.line),
                   fmt::format("{}: in_zone {}, but {} people are there who may head for it", id,
                               row["in_zone"], may_be));
      break;
    }
  }
}

void ExitsCheck::add(const formats::DatasetInfo& info, const formats::Image& image,
                     Findings& findings) {
  const std::string file = ground_truth_file(annotate::GroundTruth::exits, image.run);
  Run& run = read(info, image.run, findings);
  const auto exits = image.record.find("exits");
  if (exits == image.record.end()) return;
  for (const json& exit : *exits) {
    check_values(file, image, exit, run, findings);
    check_polygons(image, exit, findings);
  }
  if (exits->size() != run.order.size()) {
    findings.add("exits", formats::kCocoFile, fmt::format("image {}", image.id),
                 fmt::format("{} exits, but {} has {}", exits->size(), file, run.order.size()));
  }
  count_people(file, image, run, findings);
}

void ExitsCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const auto& [name, run] : runs_) {
    if (info.has(annotate::GroundTruth::trajectories)) {
      try {
        count_everybody(info, name, run, findings);
      } catch (const std::exception& error) {
        findings.add("exits", ground_truth_file(annotate::GroundTruth::trajectories, name), "",
                     error.what());
      }
    }
    const std::filesystem::path file = info.root / "metrics" / (name + ".json");
    if (run.wanted.empty() || !std::filesystem::is_regular_file(file)) continue;
    const json figures = parse_json_or_discard(read_file(file), kOwnJsonLimits);
    if (!figures.is_object()) continue;  // check_metrics says so
    const json people = figures.value("by_person", json::object());
    const json agents = people.value("agent", json::array());
    const json used = people.value("exit", json::array());
    std::size_t left = 0;
    std::size_t as_wanted = 0;
    for (std::size_t i = 0; i < std::min(agents.size(), used.size()); ++i) {
      if (!used[i].is_string()) continue;
      const std::int64_t number = agents[i].get<std::int64_t>() + 1;
      const auto wanted = std::find_if(
          run.wanted.begin(), run.wanted.end(),
          [&](const auto& entry) { return entry.first % annotate::kTrackIdsPerRun == number; });
      if (wanted == run.wanted.end()) continue;
      ++left;
      as_wanted += used[i] == wanted->second ? 1 : 0;
    }
    constexpr double kMaxOthers = 0.6;  // plans change
    if (!is_above_share(left - as_wanted, left, kMaxOthers, 1)) continue;
    findings.add(
        "exits", formats::kCocoFile, name,
        fmt::format("{} of {} people go out by the exit that their records say", as_wanted, left));
  }
}

}  // namespace throng::checks
