#include "world/fields/ground_fields.h"

#include <array>
#include <nlohmann/json.hpp>

#include "world/fields/document_values.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMinMarkingM = 0.05;
constexpr double kWaterM = -2.5;

fields::Values area_materials() {
  return fields::one_of_words(
      std::array{"pavers", "asphalt", "grass", "concrete", "dirt", "water"});
}

}  // namespace

fields::Values ground_materials() {
  return fields::one_of_words(std::array{"pavers", "asphalt", "grass", "concrete", "dirt"});
}

const FieldTable<GroundArea>& area_fields() {
  static const FieldTable<GroundArea> fields = [] {
    FieldTable<GroundArea> table;
    table
        .add_read(
            "corners", polygons(),
            [](GroundArea& area, const json& value, const FieldLocation& place) {
              area.corners = read_polygon(value, place, true);
            },
            "Corners in order; the edges must not cross.")
        .measured_in("m")
        .required();
    table
        .add_read(
            "material", area_materials(),
            [](GroundArea& area, const json& value, const FieldLocation& /*place*/) {
              area.material = value;
              if (area.material == "water") area.level_m = kWaterM;
            },
            "Material of the ground, or water, whose banks are walls; areas above it are bridges.")
        .required();
    table
        .add_read(
            "level_m", fields::numbers(-12, -0.3),
            [](GroundArea& area, const json& value, const FieldLocation& place) {
              area.level_m = value;
              if (area.material != "water") place.reject("a level", "none, which only water has");
            },
            "Height of the surface of water; default: -2.5.")
        .measured_in("m")
        .without_default();
    table
        .add_read(
            "kerb", fields::integers(0, 1),
            [](GroundArea& area, const json& value, const FieldLocation& /*place*/) {
              area.kerb = value == 1;
            },
            "1 edges the area with kerb stones.")
        .with_default(0);
    return table;
  }();
  return fields;
}

const FieldTable<Marking>& marking_fields() {
  static const FieldTable<Marking> fields = [] {
    FieldTable<Marking> table;
    table
        .add("kind", "", "",
             fields::one_of_words(std::array{"line", "dashes", "crossing", "pitch", "track"}),
             at(&Marking::kind),
             "Kind of marking. The bars of a crossing lie side by side along it; a pitch for "
             "football has its goal lines at both ends; a track has rails, sleepers and ballast.")
        .required();
    table.add("from", "", "m", points(), at(&Marking::from), "Start of the strip.").required();
    table.add("to", "", "m", points(), at(&Marking::to), "End of the strip.").required();
    table
        .add("width_m", "", "m", fields::numbers(kMinMarkingM, 120), at(&Marking::width_m),
             "Width of a line (default 0.12) or of a pitch (68), length of a crossing's bars (4).")
        .without_default();
    return table;
  }();
  return fields;
}

void check_markings(Scenario& scenario, const json& list, const FieldLocation& place) {
  constexpr double kCrossingM = 4;
  constexpr double kPitchM = 68;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Marking& marking = scenario.markings[i];
    if (!list[i].contains("width_m")) {
      if (marking.kind == "crossing") marking.width_m = kCrossingM;
      if (marking.kind == "pitch") marking.width_m = kPitchM;
    }
    check_ends(marking.from, marking.to, kMinMarkingM, list[i], place.below(i));
  }
}

}  // namespace throng::world
