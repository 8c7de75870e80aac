#include "metrics/trajectories/column_roles.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numeric>

#include "base/text/words.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/trajectory_words.h"

namespace throng::metrics {

namespace {

// Names that others give to the columns whose default is the first one, as bare_name() has them.
using Synonyms = std::vector<std::string_view>;
const Synonyms& column_synonyms(const std::string& name) {
  static const std::map<std::string, Synonyms> kNames = {
      {"id",
       {"id", "person", "personid", "persid", "pid", "ped", "pedid", "pedestrian", "pedestrianid",
        "agent", "agentid", "track", "trackid", "no", "name"}},
      {"frame", {"frame", "fr", "frameid", "framenumber", "frameno", "frames"}},
      {"time",
       {"time", "t", "times", "timestamp", "unixtime", "simtime", "simsec", "seconds", "datetime",
        "timesteptime", "zeit", "milliseconds", "ms"}},
      {"x",
       {"x", "posx", "xpos", "positionx", "xposition", "locationx", "startx", "coordcentx",
        "centerx", "xcenter", "personx"}},
      {"y",
       {"y", "posy", "ypos", "positiony", "yposition", "locationy", "starty", "coordcenty",
        "centery", "ycenter", "persony"}}};
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

/// The unit that ends a bare name behind the synonym of a column: "xft", "posxinfeet", "timems".
std::optional<Unit> glued_unit(std::string_view bare, std::string_view synonym) {
  if (!bare.starts_with(synonym) || bare.size() == synonym.size()) return std::nullopt;
  std::string_view rest = bare.substr(synonym.size());
  Unit unit = unit_of_word(rest);
  if (unit.kind == Unit::Kind::unknown && rest.starts_with("in")) {
    unit = unit_of_word(rest.substr(2));
  }
  return unit.kind == Unit::Kind::unknown ? std::nullopt : std::optional(unit);
}

bool suits_column(const Unit& unit, const std::string& column) {
  if (column == "time") return unit.kind == Unit::Kind::time || unit.kind == Unit::Kind::frames;
  return (column == "x" || column == "y") && unit.is_of_positions();
}

/// Whether a name means the same as a synonym, with or without a unit. Pixels are a second choice.
bool means(std::string_view name, std::string_view synonym, const std::string& column,
           bool also_pixels) {
  const std::string bare = bare_name(name);
  auto unit = glued_unit(bare, synonym);
  if (bare != synonym && !(unit && suits_column(*unit, column))) return false;
  if (!unit) unit = unit_in_name(name);
  return also_pixels || !unit || unit->kind != Unit::Kind::pixels;
}

/// The unit in a name, by itself or behind a synonym of one of the columns.
std::optional<Unit> unit_of_column(std::string_view name,
                                   std::initializer_list<const char*> columns) {
  auto unit = unit_in_name(name);
  const std::string bare = bare_name(name);
  for (const char* column : columns) {
    for (const std::string_view synonym : column_synonyms(column)) {
      if (unit) break;
      unit = glued_unit(bare, synonym);
      if (unit && !suits_column(*unit, column)) unit.reset();
    }
    if (!unit || suits_column(*unit, column)) continue;
    // "x_min" is no unit, "x/min" is a wrong one.
    if (name.find_first_of("/[(") == std::string_view::npos) return std::nullopt;
    unit->kind = Unit::Kind::unknown;
  }
  return unit;
}

/// The median distance between the places of the same person in consecutive rows of the order of
/// frames, if the person is given by `person` and the frame by `frame`; nothing without such rows.
template <double UnnamedRow::*person, double UnnamedRow::*frame>
std::optional<double> median_distance(std::vector<UnnamedRow> rows) {
  std::sort(rows.begin(), rows.end(), [](const UnnamedRow& a, const UnnamedRow& b) {
    return a.*person != b.*person ? a.*person < b.*person : a.*frame < b.*frame;
  });
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].*person != rows[i - 1].*person) continue;
    steps.push_back((rows[i].place - rows[i - 1].place).norm());
  }
  if (steps.empty()) return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// The greatest common factor of the differences of a column's numbers; 1 if there are fewer than
/// three different numbers.
template <double UnnamedRow::*column>
std::int64_t common_factor(const std::vector<UnnamedRow>& rows) {
  const auto first = static_cast<std::int64_t>(rows.front().*column);
  std::int64_t factor = 0;
  std::int64_t other = first;
  bool are_three = false;
  for (const UnnamedRow& row : rows) {
    const auto number = static_cast<std::int64_t>(row.*column);
    factor = std::gcd(factor, number - first);
    are_three = are_three || (number != first && number != other && other != first);
    if (number != first) other = number;
  }
  return are_three ? factor : 1;
}

}  // namespace

std::optional<std::size_t> column_named(const std::vector<std::string_view>& names,
                                        const std::string& wanted) {
  const auto at = [&](auto found) { return static_cast<std::size_t>(found - names.begin()); };
  const auto exact = std::find(names.begin(), names.end(), wanted);
  if (exact != names.end()) return at(exact);
  for (const bool also_pixels : {false, true}) {
    for (const std::string_view synonym : column_synonyms(wanted)) {
      const auto found = std::find_if(names.begin(), names.end(), [&](std::string_view name) {
        return means(name, synonym, wanted, also_pixels);
      });
      if (found != names.end()) return at(found);
    }
  }
  return std::nullopt;
}

std::optional<Unit> unit_of_positions(std::string_view name) {
  return unit_of_column(name, {"x", "y"});
}

std::optional<Unit> unit_of_times(std::string_view name) {
  const auto unit = unit_of_column(name, {"time"});
  if (!unit) {
    const Unit whole = unit_of_word(name);
    return whole.kind == Unit::Kind::time ? std::optional(whole) : std::nullopt;
  }
  const std::string word = lower_case(unit->word);
  const bool is_of_clock = word.find(':') != std::string::npos ||
                           word.find("utc") != std::string::npos || word == "gmt" ||
                           word == "unix" || word == "epoch" || word == "local" || word == "iso";
  return is_of_clock ? std::nullopt : unit;
}

std::size_t ColumnRoles::last() const { return std::max({person, when, x, y}); }

std::optional<ColumnRoles> numbered_columns(const TrajectoryColumns& columns) {
  const bool by_time = !columns.time.empty();
  const auto person = number_of_column(columns.person);
  const auto when = number_of_column(by_time ? columns.time : columns.frame);
  const auto x = number_of_column(columns.x);
  const auto y = number_of_column(columns.y);
  if (!person || !when || !x || !y) return std::nullopt;
  return ColumnRoles{*person, *when, *x, *y, by_time};
}

std::optional<ColumnRoles> named_columns(const std::vector<std::string_view>& names,
                                         const TrajectoryColumns& wanted, std::string& missing) {
  ColumnRoles roles;
  roles.by_time = !wanted.time.empty();
  const auto find = [&](const std::string& name, std::size_t& column) {
    const auto found = column_named(names, name);
    if (found) {
      column = *found;
    } else if (missing.empty()) {
      missing = name == "frame" ? "frame\" or \"time" : name;
    }
    return found.has_value();
  };
  find(wanted.person, roles.person);
  if (roles.by_time) {
    find(wanted.time, roles.when);
  } else if (wanted.frame == "frame" && !column_named(names, wanted.frame)) {
    roles.by_time = column_named(names, "time").has_value();
    find(roles.by_time ? "time" : "frame", roles.when);
  } else {
    find(wanted.frame, roles.when);
  }
  find(wanted.x, roles.x);
  find(wanted.y, roles.y);
  if (!missing.empty()) return std::nullopt;
  return roles;
}

ColumnOrder order_of_columns(const std::vector<UnnamedRow>& all, bool states_rate) {
  constexpr std::size_t kEnough = 200'000;
  constexpr double kClear = 1.5;
  constexpr double kVeryClear = 5;
  if (all.size() < 2) return ColumnOrder::person_first;
  const std::vector<UnnamedRow> rows(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kEnough)));
  int person_first = states_rate ? 1 : 0;
  int frame_first = 0;
  const auto step = median_distance<&UnnamedRow::first, &UnnamedRow::second>(rows);
  const auto swapped = median_distance<&UnnamedRow::second, &UnnamedRow::first>(rows);
  if (step && swapped) {
    if (*step * kClear < *swapped) person_first += *step * kVeryClear < *swapped ? 4 : 2;
    if (*swapped * kClear < *step) frame_first += *swapped * kVeryClear < *step ? 4 : 2;
  } else {
    person_first += step ? 1 : 0;
    frame_first += swapped ? 1 : 0;
  }
  const bool first_has_factor = common_factor<&UnnamedRow::first>(rows) > 1;
  const bool second_has_factor = common_factor<&UnnamedRow::second>(rows) > 1;
  if (first_has_factor && !second_has_factor) frame_first += 2;
  if (second_has_factor && !first_has_factor) person_first += 2;
  if (person_first == 0 && frame_first == 0 && !step && !swapped) return ColumnOrder::person_first;
  if (person_first == frame_first) return ColumnOrder::unclear;
  return person_first > frame_first ? ColumnOrder::person_first : ColumnOrder::frame_first;
}

}  // namespace throng::metrics
