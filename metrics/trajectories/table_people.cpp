#include "metrics/trajectories/table_people.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "metrics/trajectories/number_in.h"

namespace throng::metrics {

namespace {

constexpr double kMaxId = 1e15;

/// The id of a person as a number; nothing for other words.
std::optional<std::int64_t> id_number(std::string_view word) {
  const auto number = number_in(word);
  if (!number || *number != std::floor(*number) || std::abs(*number) > kMaxId) return std::nullopt;
  return std::llround(*number);
}

}  // namespace

bool TablePeople::add(std::string_view person, double when, const Eigen::Vector2d& place) {
  const auto number = id_number(person);
  const std::string key = number ? fmt::format("{}", *number) : std::string(person);
  const auto [known, is_new] = indices_.try_emplace(key, tracks_.size());
  if (is_new) {
    tracks_.emplace_back();
    ids_.push_back(number.value_or(0));
    are_numbers_ = are_numbers_ && number.has_value();
  }
  return tracks_[known->second].try_emplace(when, place).second;
}

void TablePeople::scale_y(double factor) {
  for (Track& track : tracks_) {
    for (auto& [when, place] : track) place.y() *= factor;
  }
}

void TablePeople::put_frames(Recorded& recorded) const {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    auto& places = recorded.places[id(i)];
    for (const auto& [frame, place] : tracks_[i]) places[std::llround(frame)] = place;
  }
}

TimedPeople TablePeople::take_timed(bool spans_gaps) {
  TimedPeople people{{}, std::move(tracks_), spans_gaps};
  for (std::size_t i = 0; i < people.tracks.size(); ++i) people.ids.push_back(id(i));
  return people;
}

void TablePeople::put_names(Recorded& recorded) const {
  if (are_numbers_) return;
  for (const auto& [word, person] : indices_) recorded.names[id(person)] = word;
}

}  // namespace throng::metrics
