#include "world/fields/stand_fields.h"

#include <nlohmann/json.hpp>

#include "world/fields/document_values.h"
#include "world/fields/paint_values.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMinStandM = 2;

void set_colors(Stand& stand, const json& list, const FieldLocation& /*place*/) {
  for (const json& color : list) stand.colors.push_back(paint_from_hex(color));
}

const FieldTable<Spectators>& spectator_fields() {
  static const FieldTable<Spectators> fields = [] {
    FieldTable<Spectators> table;
    table
        .add("count", "", "", fields::integers(0, 20000), at(&Spectators::count),
             "Number of spectators.")
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

void check_stands(Scenario& scenario, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Stand& stand = scenario.stands[i];
    check_ends(stand.from, stand.to, kMinStandM, list[i], place.below(i));
  }
  check_ids(scenario.stands, place);
}

}  // namespace throng::world
