#include "metrics/trajectories/trajectory_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
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
#include "base/resource_exhaustion.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/trajectory_words.h"

namespace throng::metrics {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

constexpr std::int64_t kMaxFrames = 10'000'000;
constexpr std::size_t kMaxPairs = 40'000'000;  ///< frames times people
constexpr double kMaxPersonId = 1e15;
constexpr double kMaxCoordinateM = 100'000;
constexpr double kMinRate = 0.01;
constexpr double kMaxRate = 10'000;
constexpr std::string_view kDatabaseStart = "SQLite format 3";

std::vector<std::string_view> split_words(std::string_view line) {
  constexpr std::string_view kBetween = " \t,;\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBetween); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBetween, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBetween, end);
  }
  return words;
}

class TextReader {
 public:
  TextReader(std::string_view text, std::string name, const TrajectoryFormat& format)
      : text_(text), name_(std::move(name)), given_rate_(format.frames_per_s) {}

  Recorded read() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_;
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    if (given_rate_) recorded_.frames_per_s = *given_rate_;
    if (recorded_.frames_per_s <= 0) {
      throw InputError({name_, "", "no frame rate", "a comment like \"# framerate: 16\""});
    }
    return std::move(recorded_);
  }

 private:
  void read_line(std::string_view line) {
    const std::vector<std::string_view> words = split_words(line);
    if (words.empty()) return;
    if (words.front().front() == '#') {
      if (const auto rate = frame_rate_in(line)) recorded_.frames_per_s = *rate;
      if (const auto unit = unit_in(line)) recorded_.unit_m = *unit;
      return;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, words.size()); ++i) {
      const auto number = number_in(words[i]);
      if (!number || (i < 2 && *number != std::floor(*number))) reject(std::string(words[i]));
      numbers.push_back(*number);
    }
    if (numbers.size() < 4) reject(fmt::format("{} values", numbers.size()));
    if (std::abs(numbers[0]) > kMaxPersonId) reject(std::string(words[0]));
    if (std::abs(numbers[1]) > kMaxFrames) reject(std::string(words[1]));
    const auto place = recorded_.places[std::llround(numbers[0])].try_emplace(
        std::llround(numbers[1]), numbers[2], numbers[3]);
    if (!place.second) reject("the same person and frame again");
  }

  [[noreturn]] void reject(const std::string& found) const {
    throw InputError({name_, fmt::format("line {}", line_), found,
                      "id, frame (whole numbers), x and y, each person once a frame"});
  }

  std::string_view text_;
  std::string name_;
  int line_ = 0;
  std::optional<double> given_rate_;
  Recorded recorded_;
};

Recorded read_database(const fs::path& file, const TrajectoryFormat& format) {
  try {
    const SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
    Recorded recorded;
    SQLite::Statement rate(database, "SELECT value FROM metadata WHERE key = 'fps'");
    if (rate.executeStep()) recorded.frames_per_s = rate.getColumn(0).getDouble();
    if (format.frames_per_s) recorded.frames_per_s = *format.frames_per_s;
    if (!(recorded.frames_per_s > 0)) {
      throw InputError({file.string(), "table metadata", "no fps", "a number above 0"});
    }
    SQLite::Statement rows(database, "SELECT id, frame, pos_x, pos_y FROM trajectory_data");
    while (rows.executeStep()) {
      const std::int64_t frame = rows.getColumn(1).getInt64();
      const auto place = recorded.places[rows.getColumn(0).getInt64()].try_emplace(
          frame, rows.getColumn(2).getDouble(), rows.getColumn(3).getDouble());
      if (!place.second || frame > kMaxFrames || frame < -kMaxFrames) {
        throw InputError({file.string(), "table trajectory_data", fmt::format("frame {}", frame),
                          "frames within 10 million, each person once a frame"});
      }
    }
    return recorded;
  } catch (const SQLite::Exception& error) {
    throw InputError({file.string(), "", error.what(),
                      "a database of JuPedSim: tables trajectory_data and metadata"});
  }
}

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

// As JuPedSim 1.x writes it, version 2, without a geometry.
void fill_database(const world::Trace& trace, SQLite::Database& database) {
  SQLite::Transaction transaction(database);
  database.exec(
      "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT "
      "NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);"
      "CREATE TABLE metadata (key TEXT NOT NULL UNIQUE, value TEXT NOT NULL);"
      "CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
      "CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
      "CREATE INDEX frame_id_idx ON trajectory_data (frame, id)");
  SQLite::Statement metadata(database, "INSERT INTO metadata VALUES (?, ?)");
  metadata.bind(1, "version");
  metadata.bind(2, "2");
  metadata.exec();
  metadata.reset();
  metadata.bind(1, "fps");
  metadata.bind(2, fmt::format("{}", 1 / trace.header.dt_s));
  metadata.exec();
  SQLite::Statement row(database, "INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)");
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
      if (trace.header.role[agent] != world::AgentRole::person || !trace.present(step, agent)) {
        continue;
      }
      const std::size_t at = trace.at(step, agent);
      row.bind(1, static_cast<std::int64_t>(step));
      row.bind(2, static_cast<std::int64_t>(agent) + 1);
      row.bind(3, trace.position[at].x());
      row.bind(4, trace.position[at].y());
      row.bind(5, std::cos(trace.yaw_rad[at]));
      row.bind(6, std::sin(trace.yaw_rad[at]));
      row.exec();
      row.reset();
    }
  }
  transaction.commit();
}

// Whether the first line that is no comment names columns.
bool begins_with_names(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string_view> words = split_words(text.substr(at, end - at));
    at = end + 1;
    if (words.empty() || words.front().front() == '#') continue;
    const char first = words.front().front();
    return first == '"' || (first >= 'A' && first <= 'Z') || (first >= 'a' && first <= 'z');
  }
  return false;
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

TrajectoryKind detect_kind(const fs::path& file, std::string_view bytes) {
  if (file.extension() == ".scb") return TrajectoryKind::scb;
  if (file.extension() == ".csv") return TrajectoryKind::csv;
  if (bytes.starts_with(kDatabaseStart)) return TrajectoryKind::sqlite;
  return begins_with_names(bytes) ? TrajectoryKind::csv : TrajectoryKind::text;
}

Recorded read_recorded(const fs::path& file, const TrajectoryFormat& format) {
  std::string whole = read_file(file);
  fs::path name = file;
  if (is_gzip(whole)) {
    whole = gunzipped(whole, file.string());
    name = file.stem();
  }
  const std::string_view bytes = without_byte_order_mark(whole);
  const TrajectoryKind kind =
      format.kind == TrajectoryKind::any ? detect_kind(name, bytes) : format.kind;
  if (name != file && (kind == TrajectoryKind::scb || kind == TrajectoryKind::sqlite)) {
    throw InputError({file.string(), "", "a compressed file of this format",
                      "text or a table (csv), or the file decompressed"});
  }
  switch (kind) {
    case TrajectoryKind::scb: {
      Recorded recorded = read_scb(file);
      if (format.frames_per_s) recorded.frames_per_s = *format.frames_per_s;
      return recorded;
    }
    case TrajectoryKind::csv:
      return read_csv(bytes, file.string(), format);
    case TrajectoryKind::sqlite:
      return read_database(file, format);
    default:
      return TextReader(bytes, file.string(), format).read();
  }
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
                             const TrajectoryFormat& format) {
  Recorded recorded = read_recorded(file, format);
  count_by_steps(recorded);
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

void write_trajectory(const world::Trace& trace, const fs::path& file) {
  if (file.extension() == ".scb") return write_scb(trace, file);
  if (file.extension() != ".sqlite") return write_file_atomically(file, trajectory_text(trace));
  try {
    StagedFile staged(file);
    {
      SQLite::Database database(staged.path().string(),
                                SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
      fill_database(trace, database);
    }
    staged.commit();
  } catch (const SQLite::Exception& error) {
    constexpr int kFull = 13;  // SQLITE_FULL
    if (error.getErrorCode() == kFull) throw_write_error(file, ENOSPC);
    throw EnvironmentError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace throng::metrics
