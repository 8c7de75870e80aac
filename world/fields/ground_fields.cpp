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
        .add("material", "", "", ground_materials(), at(&GroundArea::material),
             "Material of the ground.")
        .required();
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
        .add("kind", "", "", fields::one_of_words(std::array{"line", "dashes", "crossing"}),
             at(&Marking::kind),
             "Kind of marking; the bars of a crossing lie side by side along it.")
        .required();
    table.add("from", "", "m", points(), at(&Marking::from), "Start of the strip.").required();
    table.add("to", "", "m", points(), at(&Marking::to), "End of the strip.").required();
    table
        .add("width_m", "", "m", fields::numbers(kMinMarkingM, 20), at(&Marking::width_m),
             "Width of a line (default 0.12), or length of a crossing's bars (default 4).")
        .without_default();
    return table;
  }();
  return fields;
}

void check_markings(Scenario& scenario, const json& list, const FieldLocation& place) {
  constexpr double kCrossingM = 4;
  for (std::size_t i = 0; i < list.size(); ++i) {
    Marking& marking = scenario.markings[i];
    if (marking.kind == "crossing" && !list[i].contains("width_m")) marking.width_m = kCrossingM;
    check_ends(marking.from, marking.to, kMinMarkingM, list[i], place.below(i));
  }
}

}  // namespace throng::world
