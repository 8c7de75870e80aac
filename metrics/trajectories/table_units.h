// Units of the positions and times of a table, which its comments, names of columns and rows state.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "metrics/trajectories/column_roles.h"
#include "metrics/trajectories/table_fields.h"
#include "metrics/trajectories/unit_words.h"

namespace throng::metrics {

struct TableUnits {
  bool are_given = false;  ///< by the user, against the file
  double x_m = 1;
  double y_m = 1;
  bool are_stated = false;  ///< by the file
  double time_s = 1;
};

// The following functions throw InputError for units that cannot be used.

/// Takes units of x and y; an axis without one has the other's.
void state_units(TableUnits& units, const std::optional<Unit>& x, const std::optional<Unit>& y,
                 const TableLine& line);

/// Takes units from a comment with these words, which may name columns ("x/cm y/cm") or be
/// sentences.
void state_units_in_comment(TableUnits& units, std::string_view comment,
                            const std::vector<std::string_view>& words, const TableLine& line);

/// Takes units from a comment of Viswalk, which explains a column.
void state_units_in_explanation(TableUnits& units, std::string_view comment, const TableLine& line);

/// Takes units from the names of columns; `roles` learn whether times are frames.
void state_units_in_names(TableUnits& units, const std::vector<std::string_view>& names,
                          ColumnRoles& roles, const TableLine& line);

/// Takes units from the row below the names, if that has units. Returns whether it has.
bool state_units_in_row(TableUnits& units, const std::vector<std::string_view>& fields,
                        const ColumnRoles& roles, const TableLine& line);

}  // namespace throng::metrics
