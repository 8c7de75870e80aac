// The columns of a table of trajectories that hold persons, frames or times, and places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "metrics/trajectories/unit_words.h"
#include "spec/metrics/trajectory_format.h"

namespace throng::metrics {

/// Columns of a table, counted from 0.
struct ColumnRoles {
  std::size_t person = 0;
  std::size_t when = 1;
  std::size_t x = 2;
  std::size_t y = 3;
  bool by_time = false;  ///< `when` is a time (s), not a frame

  std::size_t last() const;
};

/// The columns that a user names by numbers from 1; nothing if any of them has a name.
std::optional<ColumnRoles> numbered_columns(const TrajectoryColumns& columns);

/// Finds columns by their names: exactly, or, of default names, by ones that mean the same
/// ("ped_id", "Pos_X [cm]", "startX-PID1"). Returns nothing and sets `missing` to the name of a
/// column that is not there. `by_time`: a missing column of frames was replaced by one of times.
std::optional<ColumnRoles> named_columns(const std::vector<std::string_view>& names,
                                         const TrajectoryColumns& wanted, std::string& missing);

/// The column with this exact name or, for the default names "id", "frame", "time", "x" and "y",
/// one that means the same, also with a unit ("posx_cm", "timeMs"); of several, the first that is
/// not in pixels.
std::optional<std::size_t> column_named(const std::vector<std::string_view>& names,
                                        const std::string& wanted);

/// The unit that the name of a column of positions states; of the kind `unknown` if it cannot be
/// one of positions.
std::optional<Unit> unit_of_positions(std::string_view name);

/// The unit that the name of a column of times states, or frames; of the kind `unknown` if it
/// cannot be one of times. Nothing for words about clocks ("time [UTC]").
std::optional<Unit> unit_of_times(std::string_view name);

/// A row of a table without names: its first two numbers and its place.
struct UnnamedRow {
  double first = 0;
  double second = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  int line = 0;
};

enum class ColumnOrder : std::uint8_t { person_first, frame_first, unclear };

/// Tells from the rows which of the first two columns is the person: people move little between
/// their frames, compared with the distances between people of a frame, and numbers that have a
/// common factor are frames. `states_rate`: a comment states the frame rate, as in the text of
/// JuPedSim, whose first column is the person.
ColumnOrder order_of_columns(const std::vector<UnnamedRow>& rows, bool states_rate);

}  // namespace throng::metrics
