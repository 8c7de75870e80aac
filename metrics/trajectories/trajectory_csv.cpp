// Tables of trajectories whose columns the user names.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/trajectory_file.h"
#include "metrics/trajectories/trajectory_words.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kMaxGapS = 1;
constexpr double kMaxTimeS = 1e6;

char detect_separator(std::string_view line) {
  constexpr std::array kSeparators = {',', ';', '\t'};
  const char most_frequent =
      *std::max_element(kSeparators.begin(), kSeparators.end(), [&](char a, char b) {
        return std::count(line.begin(), line.end(), a) < std::count(line.begin(), line.end(), b);
      });
  return line.find(most_frequent) == std::string_view::npos ? ' ' : most_frequent;
}

std::string_view unquoted(std::string_view text) {
  std::string_view field = trimmed(text, " \r");
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = field.substr(1, field.size() - 2);
  }
  return field;
}

std::vector<std::string_view> split_fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] != separator || quoted) continue;
    fields.push_back(unquoted(line.substr(start, i - start)));
    start = i + 1;
  }
  fields.push_back(unquoted(line.substr(start)));
  if (separator == ' ') std::erase_if(fields, [](std::string_view field) { return field.empty(); });
  return fields;
}

// Names that others give to the columns whose default is the first one, as bare_name() has them.
using Synonyms = std::vector<std::string_view>;
const Synonyms& column_synonyms(const std::string& name) {
  static const std::map<std::string, Synonyms> kNames = {
      {"id",
       {"id", "person", "personid", "pid", "ped", "pedid", "pedestrian", "pedestrianid", "agent",
        "agentid", "track", "trackid", "name"}},
      {"frame", {"frame", "fr", "frameid", "framenumber", "frameno", "frames"}},
      {"time", {"time", "t", "times", "timestamp", "simtime", "seconds"}},
      {"x", {"x", "posx", "xpos", "positionx", "xm", "locationx"}},
      {"y", {"y", "posy", "ypos", "positiony", "ym", "locationy"}}};
  static const Synonyms kNone;
  const auto found = kNames.find(name);
  return found == kNames.end() ? kNone : found->second;
}

// The number of a column of a table without names, from 0.
std::optional<std::size_t> number_of_column(const std::string& name) {
  constexpr double kMaxInteger = 1000;
  const auto number = number_in(name);
  if (!number || *number != std::floor(*number) || *number < 1 || *number > kMaxInteger) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(*number) - 1;
}

/// A person's places by time or, where the table has frames, by frame.
using Track = std::map<double, Vector2d>;

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name, const TrajectoryFormat& format)
      : text_(text), name_(name), format_(format), by_time_(!format.columns.time.empty()) {
    const std::array<std::string, column_count> wanted = wanted_names();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto number = number_of_column(wanted[i]);
      if (!number) return;
      column_[i] = *number;
    }
    has_names_ = false;
  }

  std::vector<Track> read() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_;
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    return std::move(tracks_);
  }

  /// The table, after read().
  bool by_time() const { return by_time_; }
  std::optional<double> frames_per_s() const { return frames_per_s_; }
  std::optional<double> unit_m() const { return unit_m_; }

 private:
  enum Column { person_column, when_column, x_column, y_column, column_count };

  std::array<std::string, column_count> wanted_names() const {
    const TrajectoryColumns& columns = format_.columns;
    return {columns.person, by_time_ ? columns.time : columns.frame, columns.x, columns.y};
  }

  void read_line(std::string_view line) {
    if (unquoted(line).empty()) return;
    if (line.front() == '#') return read_comment(line);
    if (separator_ == 0) {
      separator_ = detect_separator(line);
      if (has_names_) return read_names(line);
    }
    const std::vector<std::string_view> fields = split_fields(line, separator_);
    const auto last = *std::max_element(column_.begin(), column_.end());
    if (fields.size() <= last) {
      reject(fmt::format("{} fields", fields.size()), fmt::format("at least {}", last + 1));
    }
    const std::string_view person = fields[column_[person_column]];
    if (person.empty()) reject("nobody", "a person's name or number");
    const double when = number(fields[column_[when_column]]);
    if (!by_time_ && when != std::floor(when))
      reject(fmt::format("frame {}", when), "a whole number");
    if (std::abs(when) > kMaxTimeS * (by_time_ ? 1 : 10)) {
      reject(fmt::format("{:g}", when), "a time within 1e6 s, or a frame within 1e7");
    }
    const auto [known, is_new] = numbers_.try_emplace(std::string(person), tracks_.size());
    if (is_new) tracks_.emplace_back();
    const Vector2d place(number(fields[column_[x_column]]), number(fields[column_[y_column]]));
    if (!tracks_[known->second].try_emplace(when, place).second) {
      reject("the same person and time again", "each person once at a time");
    }
  }

  void read_comment(std::string_view line) {
    if (const auto rate = frame_rate_in(line)) frames_per_s_ = rate;
    if (const auto unit = unit_in(line)) unit_m_ = unit;
  }

  void read_names(std::string_view line) {
    const std::vector<std::string_view> names = split_fields(line, separator_);
    const std::array<std::string, column_count> wanted = wanted_names();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      auto found = column_named(names, wanted[i]);
      if (!found && i == when_column && wanted[i] == "frame") {
        found = column_named(names, "time");
        by_time_ = found.has_value();
      }
      if (!found) {
        reject(std::string(line.substr(0, 200)), fmt::format("a column \"{}\"", wanted[i]));
      }
      column_[i] = *found;
    }
    if (const auto unit = unit_in(names[column_[x_column]])) unit_m_ = unit;
  }

  // By its exact name, else by one that means the same.
  static std::optional<std::size_t> column_named(const std::vector<std::string_view>& names,
                                                 const std::string& wanted) {
    const auto at = [&](auto found) { return static_cast<std::size_t>(found - names.begin()); };
    const auto exact = std::find(names.begin(), names.end(), wanted);
    if (exact != names.end()) return at(exact);
    for (const std::string_view synonym : column_synonyms(wanted)) {
      const auto found = std::find_if(names.begin(), names.end(), [&](std::string_view name) {
        return bare_name(name) == synonym;
      });
      if (found != names.end()) return at(found);
    }
    return std::nullopt;
  }

  double number(std::string_view field) const {
    const auto value = number_in(field);
    if (!value) reject(std::string(field.substr(0, 40)), "a number");
    return *value;
  }

  [[noreturn]] void reject(const std::string& found, const std::string& expected) const {
    throw InputError({name_, fmt::format("line {}", line_), found, expected});
  }

  std::string_view text_;
  const std::string& name_;
  const TrajectoryFormat& format_;
  bool by_time_;
  bool has_names_ = true;
  std::optional<double> frames_per_s_;  // from comments
  std::optional<double> unit_m_;
  int line_ = 0;
  char separator_ = 0;  // 0: the names have not been read yet
  std::array<std::size_t, column_count> column_{};
  std::map<std::string, std::size_t> numbers_;  // of persons, in the order of their appearance
  std::vector<Track> tracks_;
};

/// The median step between the times of any people; nothing where there is one time only.
std::optional<double> median_step_s(const std::vector<Track>& tracks) {
  std::vector<double> times;
  for (const Track& track : tracks) {
    for (const auto& [time, place] : track) times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  constexpr double kSameTimeS = 1e-4;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] - times[i - 1] > kSameTimeS) steps.push_back(times[i] - times[i - 1]);
  }
  if (steps.empty()) return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Puts a track by time on frames.
std::map<std::int64_t, Vector2d> on_frames(const Track& track, double frames_per_s) {
  constexpr double kSlack = 1e-3;  // of a frame
  std::map<std::int64_t, Vector2d> places;
  for (auto now = track.begin(); now != track.end(); ++now) {
    const double at = now->first * frames_per_s;
    if (std::abs(at - std::round(at)) < kSlack) places[std::llround(at)] = now->second;
    const auto next = std::next(now);
    if (next == track.end()) break;
    const double step_s = next->first - now->first;
    if (step_s > std::max(kMaxGapS, 1.5 / frames_per_s)) continue;
    const double until = next->first * frames_per_s - kSlack;
    for (double frame = std::floor(at + kSlack) + 1; frame < until; ++frame) {
      const double share = (frame - at) / (step_s * frames_per_s);
      places[std::llround(frame)] = (1 - share) * now->second + share * next->second;
    }
  }
  return places;
}

}  // namespace

Recorded read_csv(std::string_view text, const std::string& name, const TrajectoryFormat& format) {
  TableReader reader(text, name, format);
  const std::vector<Track> tracks = reader.read();
  const bool by_time = reader.by_time();
  Recorded recorded;
  recorded.frames_per_s = format.frames_per_s.value_or(reader.frames_per_s().value_or(0));
  recorded.unit_m = reader.unit_m().value_or(1);
  if (by_time && recorded.frames_per_s <= 0) {
    if (const auto step = median_step_s(tracks)) recorded.frames_per_s = 1 / *step;
  }
  if (!(recorded.frames_per_s > 0)) {
    throw InputError({name, "", "no frame rate",
                      "the number of frames per second (a comment \"# framerate: 16\", or said by "
                      "the user), or times"});
  }
  std::int64_t person = 0;
  for (const Track& track : tracks) {
    auto& places = recorded.places[++person];
    if (by_time) {
      places = on_frames(track, recorded.frames_per_s);
    } else {
      for (const auto& [frame, place] : track) places[std::llround(frame)] = place;
    }
    if (places.empty()) recorded.places.erase(person);
  }
  return recorded;
}

}  // namespace throng::metrics
