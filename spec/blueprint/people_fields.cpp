#include "spec/blueprint/people_fields.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/json/json_describe.h"
#include "spec/blueprint/facing_fields.h"
#include "world/fields/document_values.h"

namespace throng::scenarios {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;
using world::points;

namespace {

constexpr int kMaxPeople = 100'000;
constexpr int kMaxPeopleInLine = 1000;
constexpr double kMaxDurationS = 86'400;
constexpr SampledLimits kFreeSpeedMps = {0.1, 3, 0.19};  // Weidmann 1993: 0.26 of 1.34
constexpr SampledLimits kEvacuationSpeedMps = {0.1, 3, 0.125};
constexpr SampledLimits kPreMovementS = {0, 3600, 0};
constexpr std::array<std::string_view, 5> kDoings = {"stroll", "wait", "cross", "leave", "watch"};

template <typename Part>
void add_doing(FieldTable<Part>& table) {
  table
      .add_word(
          "doing", "", kDoings, at(&Part::doing),
          "Activity: stroll (from spot to spot, with pauses), wait (stand), cross (to an exit by "
          "chance, with a probability in proportion to its width), leave (by the exit that "
          "looks fastest) or watch (stand before a show: clap, cheer, film, dance).")
      .required();
}

template <typename Part>
void add_speed(FieldTable<Part>& table) {
  table
      .add_read(
          "speed_mps", sampled_values(kFreeSpeedMps),
          [](Part& part, const json& value, const FieldLocation& place) {
            part.speed_mps = read_sampled(value, kFreeSpeedMps, place);
          },
          "Free speed: a number is the mean of a normal distribution with a standard deviation of "
          "19 %. Default: 1.34.")
      .measured_in("m/s");
}

template <typename Part>
void add_count(FieldTable<Part>& table, int max_people) {
  table.add("count", "", "", fields::integers(1, max_people), at(&Part::count), "Number of people.")
      .required();
}

template <typename Part>
void add_facing(FieldTable<Part>& table) {
  table.add_read(
      "facing", facing_values(),
      [](Part& part, const json& value, const FieldLocation& place) {
        part.facing = read_facing(value, place);
      },
      "Direction in which people who wait look until something makes them move: \"random\" (any, "
      "another for every seed), {\"towards\": [x, y]} or {\"direction_deg\": a}, both with "
      "\"spread_deg\". Default: random.");
}

const FieldTable<Group>& group_fields() {
  static const FieldTable<Group> fields = [] {
    FieldTable<Group> table;
    table
        .add_read(
            "area", world::polygons(),
            [](Group& group, const json& value, const FieldLocation& place) {
              group.area = world::read_polygon(value, place);
            },
            "Corners in order; the edges must not cross.")
        .measured_in("m")
        .required();
    add_doing(table);
    add_count(table, kMaxPeople);
    add_facing(table);
    add_speed(table);
    return table;
  }();
  return fields;
}

void check_groups(const People& people, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const FieldLocation item = place.below(i);
    if (!world::has_valid(list[i], "doing", item) || !list[i].contains("facing")) continue;
    if (stays(people.groups[i].doing)) continue;
    item.below("facing").reject(describe(list[i]["facing"]),
                                "a group that is doing \"wait\" or \"watch\"");
  }
}

const FieldTable<Line>& line_fields() {
  static const FieldTable<Line> fields = [] {
    FieldTable<Line> table;
    table.add("from", "", "m", points(), at(&Line::from), "Head of the line.").required();
    table.add("to", "", "m", points(), at(&Line::to), "End of the line.").required();
    add_count(table, kMaxPeopleInLine);
    add_facing(table);
    add_speed(table);
    return table;
  }();
  return fields;
}

fields::Values exit_names() {
  return fields::raw({{"type", "string"}, {"minLength", 1}}, "the id of an exit");
}

fields::Values arrivals() {
  nlohmann::ordered_json pair = fields::lists(2, 2, {{"type", "number"}, {"minimum", 0}}).rules;
  pair["x-expected"] = "[seconds, people]";
  return fields::open_lists(0, std::move(pair));
}

void set_arrivals(Source& source, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const json& time_s = list[i][0];
    const json& people = list[i][1];
    const FieldLocation row = place.below(i);
    fields::check_value(time_s, fields::numbers(0, kMaxDurationS), row.below(0));
    if (!fields::check_value(people, fields::integers(1, kMaxPeople), row.below(1))) continue;
    source.table.emplace_back(time_s.get<double>(), static_cast<int>(people.get<double>()));
  }
}

const FieldTable<Source>& source_fields() {
  static const FieldTable<Source> fields = [] {
    FieldTable<Source> table;
    add_doing(table);
    table.add("exit", "", "", exit_names(), at(&Source::exit_id),
              "Exit by which they come in, from 6 m outside of it.");
    table
        .add("from", "", "m", points(), at(&Source::from),
             "One end of the segment along which they come in, instead of exit.")
        .without_default();
    table.add("to", "", "m", points(), at(&Source::to), "The other end of that segment.")
        .without_default();
    table
        .add("per_minute", "", "1/min", fields::numbers(0.01, 10'000), at(&Source::per_minute),
             "People per minute (Poisson).")
        .without_default();
    table.add("until_s", "", "s", fields::numbers(1, kMaxDurationS), at(&Source::until_s),
              "Time until which they come.");
    table.add_read("table", arrivals(), set_arrivals,
                   "Arrivals as [seconds, people], for example of trains, instead of per_minute.");
    table.add("towards", "", "", exit_names(), at(&Source::towards_id), "Exit that they go to.");
    add_speed(table);
    return table;
  }();
  return fields;
}

void check_source(const json& source, const FieldLocation& place) {
  if (!source.contains("exit") && (!source.contains("from") || !source.contains("to"))) {
    place.reject("no position", "\"exit\", or \"from\" and \"to\"");
  }
  if (source.contains("table") == source.contains("per_minute")) {
    place.reject(fmt::format("{} of \"per_minute\" and \"table\"",
                             source.contains("table") ? "both" : "none"),
                 "one of them");
  }
}

void check_sources(const People& /*people*/, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].is_object()) check_source(list[i], place.below(i));
  }
}

fields::Values evacuation_speeds() {
  fields::Values values = sampled_values(kEvacuationSpeedMps);
  values.rules["type"].push_back("string");
  values.rules["anyOf"].push_back(fields::one_of_words(std::array{"unchanged"}).rules);
  values.expected = "\"unchanged\", a number or a distribution";
  return values;
}

void set_evacuation_speed(People& people, const json& value, const FieldLocation& place) {
  if (!value.is_string()) {
    people.evacuation_speed_mps = read_sampled(value, kEvacuationSpeedMps, place);
  } else if (value == "unchanged") {
    people.evacuation_speed_mps.reset();
  } else {
    place.reject(describe(value), evacuation_speeds().expected);
  }
}

/// Adds the lists of people.
void add_lists(FieldTable<People>& table) {
  table
      .add_list("groups", group_fields(), at(&People::groups),
                "People at the start, placed at random on the free ground of an area, differently "
                "for every seed of a run. They overlap nobody placed before; overlapping groups "
                "make a crowd denser in the middle.")
      .checked(check_groups);
  table.add_list("lines", line_fields(), at(&People::lines),
                 "People who stand in line. They look to its head unless they have a facing.");
  table
      .add_list("sources", source_fields(), at(&People::sources),
                "People who come in by an exit, or along a segment, until a hazard reaches it.")
      .checked(check_sources);
  table.add_read(
      "spots", fields::open_lists(0, points().rules),
      [](People& people, const json& list, const FieldLocation& /*place*/) {
        people.spots = world::read_points(list);
      },
      "Destinations of strollers; default: 24 points of their area.");
}

}  // namespace

const FieldTable<People>& people_fields() {
  static const FieldTable<People> fields = [] {
    FieldTable<People> table;
    add_lists(table);
    add_speed(table);
    table.add("in_groups", "", "", fields::numbers(0, 1), at(&People::in_groups),
              "Share of people who walk in pairs and small groups.");
    table
        .add_read(
            "pre_movement_s", sampled_values(kPreMovementS),
            [](People& people, const json& value, const FieldLocation& place) {
              people.pre_movement_s = read_sampled(value, kPreMovementS, place);
            },
            "Time from when people notice a hazard until they flee: a number holds for everybody, "
            "and social groups leave together. Default: lognormal, median 2.01 s, standard "
            "deviation of the logarithm 0.5, at most 6 s; an assumption, not a recommendation.")
        .measured_in("s");
    table
        .add_read("evacuation_speed_mps", evacuation_speeds(), set_evacuation_speed,
                  "Free speed of people who flee: a number is the mean of a normal distribution "
                  "with a standard deviation of 12.5 %; \"unchanged\" keeps the speed of before. "
                  "Default: 2.")
        .measured_in("m/s");
    return table;
  }();
  return fields;
}

}  // namespace throng::scenarios
