// Counts in zones and across lines: by themselves from frame to frame, and against the people whom
// the images show.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "base/json/json_text.h"
#include "checks/run_checks.h"
#include "formats/dataset/run_trajectories.h"

namespace throng::checks {

using annotate::GroundTruth;
using Eigen::Vector2d;
using nlohmann::json;

namespace {

using Tracks = std::set<std::int64_t>;
using Positions = CountsCheck::Positions;

/// Positions in records are rounded; on the border of an area both answers are right.
constexpr double kBorderM = 0.02;

struct CountArea {
  bool is_zone = false;
  std::string id;
  std::vector<Vector2d> corners;  ///< of a line its two ends
};

/// People who changed sides between two frames.
struct Change {
  std::vector<std::int64_t> in;
  std::vector<std::int64_t> out;
};

Vector2d read_point(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>()};
}

std::vector<CountArea> read_areas(const json& record) {
  std::vector<CountArea> areas;
  for (const json& zone : record.at("zones")) {
    CountArea& area = areas.emplace_back(CountArea{true, zone.at("id"), {}});
    for (const json& corner : zone.at("corners")) area.corners.push_back(read_point(corner));
  }
  for (const json& line : record.at("lines")) {
    areas.push_back(
        {false, line.at("id"), {read_point(line.at("start")), read_point(line.at("end"))}});
  }
  return areas;
}

/// Zones and lines of the job are among the areas, each as it is in the job.
void check_places(const json& of_job, const json& areas, const std::string& file,
                  Findings& findings) {
  for (const char* kind : {"zones", "lines"}) {
    const json wanted = of_job.value(kind, json::array());
    const json& found = areas.at(kind);
    for (const json& area : wanted) {
      if (std::find(found.begin(), found.end(), area) != found.end()) continue;
      findings.add("zone-counts", file, area.at("id").get<std::string>(),
                   fmt::format("is not among the {} as it is in the job", kind));
    }
  }
}

std::vector<std::int64_t> parse_tracks(const std::string& cell) {
  std::vector<std::int64_t> tracks;
  std::istringstream words(cell);
  for (std::int64_t track = 0; words >> track;) tracks.push_back(track);
  return tracks;
}

/// Signed distance from the line's side that is inward, without regard to its ends.
double signed_distance(const CountArea& line, const Vector2d& place) {
  const Vector2d along = line.corners[1] - line.corners[0];
  return geometry::cross(along, Vector2d(place - line.corners[0])) / along.norm();
}

/// The net crossings inward of somebody who went from one place to the other; nothing where that
/// is not certain: near the line, or where they may have gone around its ends.
std::optional<int> certain_crossing(const CountArea& line, const Vector2d& a, const Vector2d& b) {
  constexpr double kCloseM = 0.05;
  const double way_m = (b - a).norm();
  for (const Vector2d& end : line.corners) {
    if ((a - end).norm() < 2 * way_m + 0.5) return std::nullopt;
  }
  const double before = signed_distance(line, a);
  const double after = signed_distance(line, b);
  if (std::abs(before) < kCloseM || std::abs(after) < kCloseM) return std::nullopt;
  if ((before > 0) == (after > 0)) return 0;
  if (!geometry::segments_cross<double>(a, b, line.corners[0], line.corners[1])) return 0;
  return after > 0 ? 1 : -1;
}

/// The rows of one area, from frame to frame.
class AreaRows {
 public:
  AreaRows(CountArea area, std::string file, Findings& findings)
      : area_(std::move(area)), file_(std::move(file)), findings_(&findings) {}

  void add(std::int64_t frame, const std::string& inside, const Change& change,
           const Positions* before, const Positions* now) {
    frame_ = frame;
    if (area_.is_zone) {
      add_zone(inside, change, now);
    } else {
      if (!inside.empty()) fault("people inside of a line");
      if (frame == 0 && !(change.in.empty() && change.out.empty())) {
        fault("crossings before the first frame");
      }
      if (before != nullptr && now != nullptr) check_crossings(change, *before, *now);
    }
  }

 private:
  void add_zone(const std::string& inside, const Change& change, const Positions* now) {
    for (const std::int64_t track : change.in) {
      if (!inside_.insert(track).second) fault(fmt::format("track {} enters twice", track));
    }
    for (const std::int64_t track : change.out) {
      if (inside_.erase(track) == 0) fault(fmt::format("track {} leaves, but was outside", track));
    }
    if (inside != std::to_string(inside_.size())) {
      fault(fmt::format("{} inside, but {} by who entered and left", inside, inside_.size()));
    }
    if (now == nullptr) return;
    for (const auto& [track, place] : *now) {
      const double outside_m = geometry::signed_distance_to(area_.corners, place);
      if (std::abs(outside_m) < kBorderM || (outside_m < 0) == inside_.contains(track)) continue;
      fault(fmt::format("track {} is {}, but images or trajectories show the opposite", track,
                        outside_m < 0 ? "outside" : "inside"));
    }
  }

  void check_crossings(const Change& change, const Positions& before, const Positions& now) const {
    for (const auto& [track, place] : now) {
      const auto last = before.find(track);
      if (last == before.end()) continue;
      const auto expected = certain_crossing(area_, last->second, place);
      const auto net = std::count(change.in.begin(), change.in.end(), track) -
                       std::count(change.out.begin(), change.out.end(), track);
      if (!expected || net == *expected) continue;
      fault(fmt::format("track {} crosses {} times inward, net, but {} times as images show", track,
                        net, *expected));
    }
  }

  void fault(const std::string& what) const {
    findings_->add("zone-counts", file_, fmt::format("frame {}, {}", frame_, area_.id), what);
  }

  CountArea area_;
  std::string file_;
  Findings* findings_;
  std::int64_t frame_ = 0;
  Tracks inside_;
};

void check_table(const formats::CsvTable& table, const std::vector<CountArea>& areas,
                 const std::string& file, const formats::DatasetInfo& info,
                 const std::map<std::int64_t, Positions>& seen, Findings& findings) {
  const std::vector<std::string> kColumns = {"frame",  "time_s",  "kind",    "id",  "inside",
                                             "inflow", "outflow", "entered", "left"};
  const auto frames = static_cast<std::size_t>(info.frames_per_camera);
  if (table.columns != kColumns || table.rows.size() != frames * areas.size()) {
    findings.add("zone-counts", file, "",
                 "other columns, or another number of rows, than it has areas");
    return;
  }
  std::vector<AreaRows> rows;
  rows.reserve(areas.size());
  for (const CountArea& area : areas) rows.emplace_back(area, file, findings);
  const auto places_at = [&](std::int64_t frame) -> const Positions* {
    const auto found = seen.find(frame);
    return found == seen.end() ? nullptr : &found->second;
  };
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<std::string>& row = table.rows[i];
    const auto frame = static_cast<std::int64_t>(i / areas.size());
    const CountArea& area = areas[i % areas.size()];
    const double time_s = info.from_s + static_cast<double>(frame) / info.rate_hz;
    constexpr double kRoundingS = 1e-6;
    if (row[0] != std::to_string(frame) || row[2] != (area.is_zone ? "zone" : "line") ||
        row[3] != area.id || !(std::abs(formats::parse_number(row[1]) - time_s) < kRoundingS)) {
      findings.add("zone-counts", file, fmt::format("line {}", i + 2),
                   fmt::format("not of frame {} and {}", frame, area.id));
      return;
    }
    const Change change{parse_tracks(row[7]), parse_tracks(row[8])};
    if (row[5] != std::to_string(change.in.size()) || row[6] != std::to_string(change.out.size())) {
      findings.add("zone-counts", file, fmt::format("frame {}, {}", frame, area.id),
                   "flows that are not the numbers of tracks");
    }
    rows[i % areas.size()].add(frame, row[4], change, places_at(frame - 1), places_at(frame));
  }
}

/// Positions by frame of all people of a run, seen or not.
std::map<std::int64_t, Positions> places_of_everybody(const formats::DatasetInfo& info,
                                                      const std::string& run) {
  const formats::RunTrajectories recorded = formats::read_run_trajectories(info.root, run);
  std::map<std::int64_t, Positions> frames;
  for (std::size_t frame = 0; frame < recorded.times_s.size(); ++frame) {
    Positions& places = frames[static_cast<std::int64_t>(frame)];
    for (std::size_t person = 0; person < recorded.tracks.size(); ++person) {
      if (!recorded.present(frame, person)) continue;
      places[recorded.tracks[person]] = recorded.place(frame, person);
    }
  }
  return frames;
}

}  // namespace

void CountsCheck::add(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                      Findings& findings) {
  const auto zones = image.record.find("zones");
  if (zones == image.record.end()) {
    findings.add("schema", formats::kCocoFile, fmt::format("image {}", image.id),
                 "zones are missing");
  } else {
    images_[image.run].push_back({image.id, *zones, {}});
    for (const formats::Person& person : image.people) {
      images_[image.run].back().places.push_back(person.position.head<2>());
    }
  }
  if (!is_shot_at_once(image)) return;
  Positions& places = seen_[image.run][image.frame];
  for (const formats::Person& person : image.people) {
    places.insert_or_assign(person.track_id, Vector2d(person.position.head<2>()));
  }
}

void CountsCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const std::string& run : info.runs) {
    const std::string file = ground_truth_file(GroundTruth::counts, run);
    const std::string places = "counts/" + run + ".json";
    try {
      const json record = parse_own_json(read_file(info.root / places), places);
      check_places(info.count_areas, record, places, findings);
      const std::vector<CountArea> areas = read_areas(record);
      const bool has_everybody = info.has(GroundTruth::trajectories);
      const auto places_of_frames = has_everybody ? places_of_everybody(info, run) : seen_[run];
      check_table(formats::read_csv(info.root / file), areas, file, info, places_of_frames,
                  findings);
      for (const Visible& image : images_[run]) {
        std::size_t zone = 0;
        for (const CountArea& area : areas) {
          if (!area.is_zone) continue;
          check_visible(area.id, area.corners, image, zone++, findings);
        }
      }
    } catch (const InputError& error) {
      findings.add("zone-counts", file, "", error.problems().front().found);
    } catch (const std::exception& error) {
      findings.add("zone-counts", file, "", error.what());
    }
  }
}

void CountsCheck::check_visible(const std::string& id, const std::vector<Vector2d>& corners,
                                const Visible& image, std::size_t zone, Findings& findings) {
  std::int64_t least = 0;
  std::int64_t most = 0;
  for (const Vector2d& place : image.places) {
    const double outside_m = geometry::signed_distance_to(corners, place);
    least += outside_m < -kBorderM ? 1 : 0;
    most += outside_m < kBorderM ? 1 : 0;
  }
  const json& record = image.zones.at(zone);
  const auto visible = record.at("visible").get<std::int64_t>();
  if (record.at("id") == id && visible >= least && visible <= most) return;
  findings.add("zone-counts", formats::kCocoFile, fmt::format("image {}", image.id),
               fmt::format("{} people visible in zone {}, expected {}", visible, id, least));
}

}  // namespace throng::checks
