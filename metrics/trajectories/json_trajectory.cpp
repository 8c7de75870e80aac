// Trajectories in JSON: Pathfinder's and those of TrajNet++.
#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_text.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/other_formats.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/timed_tracks.h"

namespace throng::metrics {

namespace {

constexpr double kMaxJsonNumber = 1e15;
constexpr const char* kExpected =
    "Pathfinder's {\"0\": {\"0.0\": {\"position\": {\"x\": 1, \"y\": 2}}}} or a line of TrajNet++, "
    "{\"track\": {\"f\": 0, \"p\": 1, \"x\": 1, \"y\": 2}}";

[[noreturn]] void reject(const std::string& name, const std::string& where,
                         const std::string& found) {
  throw InputError({name, where, found, kExpected});
}

double number(const nlohmann::json& object, const char* key, const std::string& name,
              const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number() || !std::isfinite(found->get<double>()) ||
      std::abs(found->get<double>()) > kMaxJsonNumber) {
    reject(name, where, fmt::format("no number \"{}\"", key));
  }
  return found->get<double>();
}

/// An object of people by id, of times each.
TimedPeople read_pathfinder(const nlohmann::json& document, const std::string& name) {
  TimedPeople people;
  for (const auto& [id, times] : document.items()) {
    const std::string pointer = "/" + shown(id);
    if (!times.is_object()) reject(name, pointer, "a person without an object of times");
    Track track;
    for (const auto& [time, entry] : times.items()) {
      const std::string where = pointer + "/" + shown(time);
      const auto time_s = number_in(time);
      if (!time_s || !entry.is_object()) reject(name, where, "no time with a position");
      const auto position = entry.find("position");
      if (position == entry.end() || !position->is_object()) {
        reject(name, where, "no \"position\"");
      }
      track.try_emplace(*time_s, number(*position, "x", name, where + "/position"),
                        number(*position, "y", name, where + "/position"));
    }
    if (track.empty()) continue;
    const auto id_number = number_in(id);
    const bool is_whole =
        id_number && *id_number == std::floor(*id_number) && std::abs(*id_number) < kMaxJsonNumber;
    if (!is_whole) reject(name, pointer, "a person whose id is no whole number");
    people.ids.push_back(std::llround(*id_number));
    people.tracks.push_back(std::move(track));
  }
  return people;
}

/// A line for each scene, which states the rate, and for each place of a person.
Recorded read_lines(std::string_view text, const std::string& name) {
  Recorded recorded;
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view one = text.substr(at, end - at);
    const std::string where = fmt::format("line {}", ++line);
    at = end + 1;
    if (one.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const nlohmann::json object = parse_json_or_discard(one);
    if (!object.is_object()) reject(name, where, shown(one));
    if (const auto scene = object.find("scene"); scene != object.end() && scene->is_object()) {
      if (scene->contains("fps")) recorded.frames_per_s = number(*scene, "fps", name, where);
      continue;
    }
    const auto track = object.find("track");
    if (track == object.end() || !track->is_object()) continue;
    if (track->contains("prediction_number") || track->contains("scene_id")) continue;
    const double frame = number(*track, "f", name, where);
    const double person = number(*track, "p", name, where);
    if (frame != std::floor(frame) || person != std::floor(person)) {
      reject(name, where, "a frame or person that is no whole number");
    }
    recorded.places[std::llround(person)].try_emplace(
        std::llround(frame), number(*track, "x", name, where), number(*track, "y", name, where));
  }
  return recorded;
}

}  // namespace

Recorded read_json_trajectories(std::string_view text, const std::string& name,
                                std::optional<double> frames_per_s) {
  const std::size_t line = text.find('\n');
  const nlohmann::json first = parse_json_or_discard(text.substr(0, line));
  if (first.is_object() && (first.contains("track") || first.contains("scene"))) {
    Recorded recorded = read_lines(text, name);
    if (frames_per_s) recorded.frames_per_s = *frames_per_s;
    if (recorded.frames_per_s > 0) return recorded;
    throw InputError({name, "", "no frame rate", kFrameRateExpected});
  }
  const nlohmann::json document = parse_json(text, name);
  if (!document.is_object()) reject(name, "", "JSON that is no object");
  TimedPeople people = read_pathfinder(document, name);
  if (people.tracks.empty()) reject(name, "", "nobody");
  Recorded recorded = put_on_frames(std::move(people), frames_per_s, name);
  recorded.unit_is_stated = true;
  return recorded;
}

}  // namespace throng::metrics
