#include "metrics/trajectories/table_units.h"

#include <fmt/format.h>

#include "base/text/words.h"
#include "metrics/trajectories/comment_units.h"

namespace throng::metrics {

using Fields = std::vector<std::string_view>;

void state_units(TableUnits& units, const std::optional<Unit>& x, const std::optional<Unit>& y,
                 const TableLine& line) {
  if ((!x && !y) || units.are_given) return;
  for (const auto& unit : {x, y}) {
    if (unit && unit->kind != Unit::Kind::length) {
      line.reject(fmt::format("positions in {}", shown(unit->word)), expected_unit(*unit));
    }
  }
  units.x_m = x ? x->factor : y->factor;
  units.y_m = y ? y->factor : x->factor;
  units.are_stated = true;
}

void state_units_in_comment(TableUnits& units, std::string_view comment, const Fields& words,
                            const TableLine& line) {
  const auto stated = [&](const char* column) -> std::optional<Unit> {
    const auto at = column_named(words, column);
    return at ? unit_of_positions(words[*at]) : std::nullopt;
  };
  auto x = stated("x");
  auto y = stated("y");
  const bool are_alike = x && y && x->word == y->word;
  // "x/y" is no unit unless somebody names columns.
  if (x && !x->is_of_positions() && !are_alike) x.reset();
  if (y && !y->is_of_positions() && !are_alike) y.reset();
  if (!x && !y) x = unit_in_comment(comment);
  state_units(units, x, y, line);
}

void state_units_in_explanation(TableUnits& units, std::string_view comment,
                                const TableLine& line) {
  const std::string lower = lower_case(comment);
  const auto unit = last_unit_in(comment);
  if (lower.find("coordcentx:") != std::string::npos) state_units(units, unit, {}, line);
  if (unit && lower.find("coordcenty:") != std::string::npos) {
    state_units(units, Unit{Unit::Kind::length, units.x_m}, unit, line);  // x comes before
  }
}

void state_units_in_names(TableUnits& units, const Fields& names, ColumnRoles& roles,
                          const TableLine& line) {
  state_units(units, unit_of_positions(names[roles.x]), unit_of_positions(names[roles.y]), line);
  if (!roles.by_time) return;
  units.time_s = 1;
  const auto unit = unit_of_times(names[roles.when]);
  if (!unit) return;
  if (unit->kind == Unit::Kind::unknown) {
    line.reject(fmt::format("times in {}", shown(unit->word)), "s, ms, us, ns, min, h or frames");
  }
  roles.by_time = unit->kind == Unit::Kind::time;
  units.time_s = unit->factor;
}

bool state_units_in_row(TableUnits& units, const Fields& fields, const ColumnRoles& roles,
                        const TableLine& line) {
  if (fields.size() <= roles.last()) return false;
  const std::string_view unit = fields[roles.x];
  if (unit.empty() || field_number(unit) || field_number(fields[roles.y]) ||
      field_number(fields[roles.when])) {
    return false;
  }
  state_units(units, unit_of_word(unit), unit_of_word(fields[roles.y]), line);
  const Unit time = unit_of_word(fields[roles.when]);
  if (time.kind == Unit::Kind::time) units.time_s = time.factor;
  return true;
}

}  // namespace throng::metrics
