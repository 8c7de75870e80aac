#include "metrics/trajectories/trajectory_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/gunzip.h"
#include "metrics/trajectories/database_trajectory.h"
#include "metrics/trajectories/other_formats.h"
#include "metrics/trajectories/recorded.h"
#include "metrics/trajectories/recorded_findings.h"
#include "metrics/trajectories/scb_trajectory.h"
#include "metrics/trajectories/table_reader.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/walkable_area.h"

namespace throng::metrics {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

constexpr std::int64_t kMaxFrames = 10'000'000;
constexpr std::size_t kMaxPairs = 40'000'000;  ///< frames times people
constexpr double kMaxCoordinateM = 100'000;
constexpr double kMinRate = 0.01;
constexpr double kMaxRate = 10'000;
constexpr std::string_view kDatabaseStart = "SQLite format 3";
constexpr std::string_view kHdf5Start = "\x89HDF\r\n\x1A\n";

// Central differences; one-sided at the ends; 0 for who is there in one frame only.
Vector2d velocity_at(const std::map<std::int64_t, Vector2d>& places, std::int64_t frame,
                     double frames_per_s) {
  const auto now = places.find(frame);
  const auto before = places.contains(frame - 1) ? std::prev(now) : now;
  const auto after = places.contains(frame + 1) ? std::next(now) : now;
  const auto frames = static_cast<double>(after->first - before->first);
  if (frames == 0) return Vector2d::Zero();
  return (after->second - before->second) * frames_per_s / frames;
}

void add_people(const Recorded& recorded, std::int64_t first, const WalkerDefaults& walkers,
                world::Trace& trace) {
  const std::size_t count = trace.steps() * recorded.places.size();
  trace.position.assign(count, Eigen::Vector2f::Zero());
  trace.velocity.assign(count, Eigen::Vector2f::Zero());
  trace.yaw_rad.assign(count, 0);
  trace.desired_speed_mps.assign(count, static_cast<float>(walkers.desired_speed_mps));
  trace.state.assign(count, 0);
  trace.exit_intent.assign(count, -1);
  trace.flags.assign(count, 0);
  std::size_t agent = 0;
  for (const auto& [id, places] : recorded.places) {
    for (const auto& [frame, place] : places) {
      const std::size_t at = trace.at(static_cast<std::size_t>(frame - first), agent);
      const Vector2d velocity = velocity_at(places, frame, recorded.frames_per_s);
      trace.position[at] = place.cast<float>();
      trace.velocity[at] = velocity.cast<float>();
      trace.yaw_rad[at] = static_cast<float>(std::atan2(velocity.y(), velocity.x()));
      trace.flags[at] = world::kPresent;
    }
    ++agent;
  }
}

std::string trajectory_text(const world::Trace& trace) {
  std::string text = fmt::format("# framerate: {}\n# ID\tFR\tx/m\ty/m\n", 1 / trace.header.dt_s);
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      if (!trace.present(step, agent)) continue;
      const Eigen::Vector2f& place = trace.position[trace.at(step, agent)];
      fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\t{}\n", agent + 1, step, place.x(),
                     place.y());
    }
  }
  return text;
}

// A person filmed at 25 frames per second and recorded in every tenth frame is present in between:
// frames are counted by the largest step that all have in common.
void count_by_steps(Recorded& recorded) {
  constexpr std::int64_t kMaxStep = 100;
  std::optional<std::int64_t> first;
  std::int64_t step = 0;
  for (const auto& [id, places] : recorded.places) {
    for (const auto& [frame, place] : places) {
      if (!first) first = frame;
      step = std::gcd(step, frame - *first);
    }
    if (step == 1) return;
  }
  if (step < 2 || step > kMaxStep) return;
  for (auto& [id, places] : recorded.places) {
    std::map<std::int64_t, Vector2d> counted;
    for (const auto& [frame, place] : places) counted[(frame - *first) / step] = place;
    places = std::move(counted);
  }
  recorded.frames_per_s /= static_cast<double>(step);
}

// The kind of text in UTF-8, by its first character.
TrajectoryKind kind_of_text(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return TrajectoryKind::text;
  if (text[first] == '<') return TrajectoryKind::fcd;
  return text[first] == '{' ? TrajectoryKind::json_text : TrajectoryKind::text;
}

// The kind of a file that is no text.
TrajectoryKind kind_of_bytes(const fs::path& file, std::string_view bytes) {
  if (file.extension() == ".scb") return TrajectoryKind::scb;
  if (bytes.starts_with(kDatabaseStart)) return TrajectoryKind::sqlite;
  return bytes.starts_with(kHdf5Start) ? TrajectoryKind::hdf5 : TrajectoryKind::any;
}

// Readers that open the file itself; nothing for text.
std::optional<Recorded> read_binary(const fs::path& file, TrajectoryKind kind,
                                    const TrajectoryFormat& format) {
  if (kind == TrajectoryKind::sqlite) return read_database(file, format.frames_per_s);
  if (kind == TrajectoryKind::hdf5)
    return read_archive_hdf5(file, format.frames_per_s, format.unit_m);
  if (kind != TrajectoryKind::scb) return std::nullopt;
  Recorded recorded = read_scb(file);
  if (format.frames_per_s) recorded.frames_per_s = *format.frames_per_s;
  return recorded;
}

Recorded read_recorded(const fs::path& file, const TrajectoryFormat& format) {
  std::string bytes = read_file(file);
  fs::path name = file;
  if (is_gzip(bytes)) {
    bytes = gunzipped(bytes, file.string());
    name = file.stem();
  }
  TrajectoryKind kind = format.kind;
  if (kind == TrajectoryKind::any) kind = kind_of_bytes(name, bytes);
  if (name != file && (kind == TrajectoryKind::scb || kind == TrajectoryKind::sqlite ||
                       kind == TrajectoryKind::hdf5)) {
    throw InputError({file.string(), "", "a compressed file of this format",
                      "text or a table (csv), or the file decompressed"});
  }
  if (auto recorded = read_binary(file, kind, format)) return *std::move(recorded);
  const std::string text = decode_text(bytes, file.string());
  if (kind == TrajectoryKind::any) kind = kind_of_text(text);
  if (kind == TrajectoryKind::fcd) return read_fcd(text, file.string(), format.frames_per_s);
  if (kind == TrajectoryKind::json_text) {
    return read_json_trajectories(text, file.string(), format.frames_per_s);
  }
  return read_table(text, file.string(), format);
}

// The median speed of all people between consecutive frames, in units of the file per second.
double median_speed(const Recorded& recorded) {
  std::vector<double> speeds;
  for (const auto& [id, places] : recorded.places) {
    for (auto now = places.begin(); now != places.end(); ++now) {
      const auto next = std::next(now);
      if (next == places.end()) break;
      speeds.push_back((next->second - now->second).norm() * recorded.frames_per_s /
                       static_cast<double>(next->first - now->first));
    }
  }
  if (speeds.empty()) return 0;
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

// Asks for a unit that neither the file nor the user states if it cannot be the meter.
void require_unit(const std::string& file, const TrajectoryFormat& format,
                  const Recorded& recorded) {
  constexpr double kMaxSpeed = 15;  // m/s; nobody runs so fast
  if (format.unit_m || recorded.unit_is_stated) return;
  const double speed = median_speed(recorded);
  if (speed <= kMaxSpeed) return;
  throw InputError({file, "",
                    fmt::format("no unit, and people who walk {:.4g} units a second", speed),
                    kUnitExpected + std::string(", or another --frame-rate")});
}

// Converts all positions to meters and refuses invalid ones, and files that exceed memory.
void check_recorded(const std::string& file, const TrajectoryFormat& format, Recorded& recorded) {
  if (!(recorded.frames_per_s >= kMinRate && recorded.frames_per_s <= kMaxRate)) {
    throw InputError({file, "", fmt::format("{:g} frames per second", recorded.frames_per_s),
                      fmt::format("{:g} to {:g}", kMinRate, kMaxRate)});
  }
  const double unit_m = format.unit_m.value_or(recorded.unit_m);
  for (auto& [id, places] : recorded.places) {
    for (auto& [frame, place] : places) {
      place *= unit_m;
      if (!(place.cwiseAbs().maxCoeff() <= kMaxCoordinateM)) {
        throw InputError({file, fmt::format("person {}, frame {}", id, frame),
                          fmt::format("[{:g}, {:g}] m", place.x(), place.y()),
                          "a place within 100 km of the origin"});
      }
    }
  }
}

}  // namespace

world::Trace read_trajectory(const fs::path& file, const WalkerDefaults& walkers,
                             const TrajectoryFormat& format, std::vector<Problem>* notes) {
  Recorded recorded = read_recorded(file, format);
  if (notes != nullptr) {
    *notes = recorded.notes;
    note_jumps(recorded, format.unit_m.value_or(recorded.unit_m), *notes);
  }
  count_by_steps(recorded);
  require_unit(file.string(), format, recorded);
  check_recorded(file.string(), format, recorded);
  if (recorded.places.empty()) {
    throw InputError({file.string(), "", "nobody", "at least one person in one frame"});
  }
  std::int64_t first = recorded.places.begin()->second.begin()->first;
  std::int64_t last = first;
  for (const auto& [id, places] : recorded.places) {
    first = std::min(first, places.begin()->first);
    last = std::max(last, places.rbegin()->first);
  }
  if (last - first > kMaxFrames) {
    throw InputError({file.string(), "", fmt::format("frames {} to {}", first, last),
                      fmt::format("at most {} frames", kMaxFrames)});
  }
  const std::size_t cells = static_cast<std::size_t>(last - first + 1) * recorded.places.size();
  if (cells > kMaxPairs) {
    throw InputError(
        {file.string(), "",
         fmt::format("{} people in {} frames", recorded.places.size(), last - first + 1),
         fmt::format("at most {} pairs of frame and person", kMaxPairs)});
  }
  world::Trace trace;
  trace.header.scenario_id = file.stem().string();
  trace.header.dt_s = 1 / recorded.frames_per_s;
  trace.header.crowd.model = world::kRecordedCrowd;
  const std::size_t people = recorded.places.size();
  trace.header.role.assign(people, world::AgentRole::person);
  trace.header.radius_m.assign(people, static_cast<float>(walkers.radius_m));
  trace.header.pref_speed_mps.assign(people, static_cast<float>(walkers.desired_speed_mps));
  trace.header.group.assign(people, -1);
  for (std::int64_t frame = first; frame <= last; ++frame) {
    trace.time_s.push_back(static_cast<double>(frame - first) / recorded.frames_per_s);
  }
  add_people(recorded, first, walkers, trace);
  return trace;
}

void write_trajectory(const world::Trace& trace, const fs::path& file,
                      const world::Scenario* scenario) {
  if (file.extension() == ".scb") return write_scb(trace, file);
  if (file.extension() == ".sqlite") {
    return write_database(trace, walkable_area_wkt(trace, scenario), file);
  }
  write_file_atomically(file, trajectory_text(trace));
}

}  // namespace throng::metrics
