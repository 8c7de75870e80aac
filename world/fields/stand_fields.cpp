#include "world/fields/stand_fields.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/json/json_describe.h"
#include "world/fields/document_values.h"
#include "world/fields/paint_values.h"
#include "world/stand_seats.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMinStandM = 2;
constexpr double kMaxStandM = 500;
constexpr int kMaxSpectators = 20000;  // of a scenario

void set_colors(Stand& stand, const json& list, const FieldLocation& /*place*/) {
  for (const json& color : list) stand.colors.push_back(paint_from_hex(color));
}

/// The block around which people walk and drones fly.
Building stand_block(const Stand& stand) {
  constexpr double kParapetM = 1.1;
  constexpr double kRoofM = 7;
  const auto outline = stand_outline(stand);
  Building block;
  block.id = stand.id;
  block.footprint = {outline.begin(), outline.end()};
  block.height_m = row_height_m(stand, stand.rows - 1) + (stand.roof ? kRoofM : kParapetM);
  block.facade = Facade::stand;
  return block;
}

const FieldTable<Spectators>& spectator_fields() {
  static const FieldTable<Spectators> fields = [] {
    FieldTable<Spectators> table;
    table
        .add("count", "", "", fields::integers(0, kMaxSpectators), at(&Spectators::count),
             "Number of spectators, at most as many as there are seats; 20000 on all stands.")
        .required();
    table.add("seed", "", "", fields::integers(0, kMaxId), at(&Spectators::seed),
              "Chooses their seats.");
    table
        .add("leave_at_s", "", "s", fields::numbers(0, 86400), at(&Spectators::leave_at_s),
             "When they begin to leave, down the aisles to the ground before the stand; default: "
             "never.")
        .without_default();
    return table;
  }();
  return fields;
}

}  // namespace

const FieldTable<Stand>& stand_fields() {
  static const FieldTable<Stand> fields = [] {
    FieldTable<Stand> table;
    add_id(table);
    table
        .add("from", "", "m", points(), at(&Stand::from),
             "Start of the front edge; the field lies on the left, the rows rise on the right.")
        .required();
    table.add("to", "", "m", points(), at(&Stand::to), "End of the front edge.").required();
    table.add("rows", "", "", fields::integers(1, 80), at(&Stand::rows), "Number of rows.");
    table.add("front_height_m", "", "m", fields::numbers(0, 12), at(&Stand::front_height_m),
              "Height of the first row's floor.");
    table.add("row_depth_m", "", "m", fields::numbers(0.6, 1.5), at(&Stand::row_depth_m),
              "Depth of a row.");
    table.add("row_rise_m", "", "m", fields::numbers(0, 0.7), at(&Stand::row_rise_m),
              "Height of a row above the one before it.");
    table.add("roof", "", "", fields::booleans(), at(&Stand::roof), "Whether a roof covers it.");
    table.add("vomitories", "", "", fields::integers(0, 20), at(&Stand::vomitories),
              "Openings through which people come from below, evenly spaced.");
    table.add_read("colors", fields::open_lists(1, paints().rules), set_colors,
                   "Colors of the seats, the first of most of them; default: blue and white.");
    table.add("text", "", "", any_texts(), at(&Stand::text),
              "Capital letters that seats of the last color write.");
    table.group("spectators", "", "People on the seats, who are labeled as everybody.")
        .without_default();
    table.add_all("spectators", spectator_fields(), at(&Stand::spectators));
    return table;
  }();
  return fields;
}

namespace {

/// Whether the front edge is neither too short nor too long.
bool has_length(const Stand& stand, const json& value, const FieldLocation& place) {
  if (!check_ends(stand.from, stand.to, kMinStandM, value, place)) return false;
  if (length_m(stand) <= kMaxStandM) return true;
  place.below("to").reject(describe(value["to"]),
                           fmt::format("an end at most {} m from \"from\"", kMaxStandM));
  return false;
}

/// Whether all spectators of the stand have seats, with those of the stands before it.
void check_seats(const Stand& stand, int before, const FieldLocation& place) {
  const FieldLocation count = place.below("spectators").below("count");
  const int spectators = stand.spectators.count;
  if (place.has_problem()) return;
  if (const std::size_t free = seats(stand).size(); static_cast<std::size_t>(spectators) > free) {
    count.reject(std::to_string(spectators), fmt::format("at most {}, its seats", free));
  } else if (before + spectators > kMaxSpectators) {
    count.reject(std::to_string(spectators),
                 fmt::format("at most {} spectators on all stands", kMaxSpectators));
  }
}

}  // namespace

void check_stands(Scenario& scenario, const json& list, const FieldLocation& place) {
  int spectators = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Stand& stand = scenario.stands[i];
    const FieldLocation here = place.below(i);
    if (!has_length(stand, list[i], here)) continue;
    check_seats(stand, spectators, here);
    spectators += stand.spectators.count;
    if (const std::size_t inner = inner_aisles(stand);
        static_cast<std::size_t>(stand.vomitories) > inner) {
      here.below("vomitories")
          .reject(std::to_string(stand.vomitories),
                  fmt::format("at most {}, its aisles between blocks of seats", inner));
    }
    scenario.buildings.push_back(stand_block(stand));
  }
  check_ids(scenario.stands, place);
}

}  // namespace throng::world
