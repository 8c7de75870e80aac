// The ground of a scenario with its exits closed, and lines that close its gaps.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "places/scenarios/check/survey.h"
#include "world/scenario.h"

namespace throng::scenarios {

using Cells = std::vector<std::uint8_t>;  ///< one flag per cell of a grid; not 0: true

/// A straight line from wall to wall through a cell of a path that leads out.
struct Chord {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  std::size_t at = 0;         ///< index of the cell in the path
  int inner = Routes::kNone;  ///< the cell of the path on the line's inner side
  double length_m() const { return (to - from).norm(); }
};

/// The grid with closed exits, with the operations for closing its gaps.
class ClosedGround {
 public:
  ClosedGround(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes);

  /// Adds the people who start inside, that is, nearer to the inner side of an exit than to the
  /// outer side of any.
  void add_people(const LoadedCrowd& loaded);

  /// Closes the cells on a line, so that no step to a neighboring cell crosses it.
  void draw(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  /// The cells of the shortest path from inside to the border of the grid, in order; empty if there
  /// is none.
  std::vector<int> way_out() const;

  /// The cells that can be reached from a cell.
  Cells reached_from(int start) const;

  /// The nearest free cells on one side of a door, along its width.
  std::vector<int> beside(const world::Exit& exit, const Eigen::Vector2d& towards) const;

  /// The connected part of the ground that each cell belongs to: 0 for all cells with a way to the
  /// border, kNone for those that are not free.
  std::vector<int> parts() const;

  /// Closes these lines and the exits, and opens all other lines.
  void close(const std::vector<Chord>& lines);

  /// Whether closing another line keeps all people and exits in `reached` connected with the line's
  /// inner side.
  bool may_close(const Chord& line, const Cells& reached);

  /// The shortest line from wall to wall through a cell; nothing if there are not two walls.
  std::optional<Chord> shortest_chord(int cell) const;

  /// Whether a path crosses a line without returning, as it would in a corner.
  bool leads_through(const std::vector<int>& way, const Chord& line) const;

  /// The index of the first cell of a path that lies on a line.
  std::size_t first_on(const Chord& line, const std::vector<int>& way) const;

  double cell_m() const { return routes_.grid.cell_m; }
  const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& doors() const { return doors_; }

 private:
  static constexpr int kUnseen = -1;

  bool is_free(int cell) const { return cell >= 0 && free_[static_cast<std::size_t>(cell)] != 0; }

  bool is_on_border(int cell) const;

  /// The four neighbors of a cell; -1 beyond the border.
  std::array<int, 4> neighbors(int cell) const;

  static std::vector<int> traced(int cell, const std::vector<int>& before);

  /// The first point in a direction that is not free, if it is nearer than `enough_m`.
  std::optional<Eigen::Vector2d> wall_from(const Eigen::Vector2d& at, const Eigen::Vector2d& along,
                                           double enough_m) const;

  bool keeps_all(const Cells& seen, const Cells& reached) const;

  const Routes& routes_;
  Cells free_;
  Cells closed_;             ///< `free_` with only the exits closed
  std::vector<int> inner_;   ///< cells in front of the open exits
  std::vector<int> outer_;   ///< cells behind them
  std::vector<int> people_;  ///< cells in which people start
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> doors_;
};

}  // namespace throng::scenarios
