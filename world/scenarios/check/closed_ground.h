// The ground of a scenario with its exits closed, and lines that close more of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "world/scenario.h"
#include "world/scenarios/check/survey.h"

namespace throng::scenarios {

using Cells = std::vector<std::uint8_t>;  ///< one per cell of a grid; not 0: yes

/// A straight line from wall to wall through a point on somebody's way out.
struct Chord {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  std::size_t at = 0;         ///< index of the cell of the way
  int inner = Routes::kNone;  ///< the cell of the way on the line's inner side
  double length_m() const { return (to - from).norm(); }
};

/// The grid with its exits closed, and all that closing its gaps needs.
class ClosedGround {
 public:
  ClosedGround(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes);

  /// Takes note of those who start inside: nearer to the inner side of an exit than to the outer
  /// side of any.
  void add_people(const LoadedCrowd& loaded);

  /// Closes the cells on a line, so that no step of one cell leads across it.
  void draw(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  /// The shortest path from inside to the border of the grid, its first cell first; empty: none.
  std::vector<int> way_out() const;

  /// The cells that can be reached from one.
  Cells reached_from(int start) const;

  /// Leaves just these lines closed, and the exits.
  void close(const std::vector<Chord>& lines);

  /// Whether a line more cuts off nobody and no exit that `reached` holds from its inner side.
  bool may_close(const Chord& line, const Cells& reached);

  /// The shortest line from wall to wall through a cell; nothing where there are no two walls.
  std::optional<Chord> shortest_chord(int cell) const;

  /// Whether a path leads through a line and does not come back, as in a corner.
  bool leads_through(const std::vector<int>& way, const Chord& line) const;

  /// The index of the first cell of a way that a line leads over.
  std::size_t first_on(const Chord& line, const std::vector<int>& way) const;

  double cell_m() const { return routes_.grid.cell_m; }
  const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& doors() const { return doors_; }

 private:
  static constexpr int kUnseen = -1;

  bool is_free(int cell) const { return cell >= 0 && free_[static_cast<std::size_t>(cell)] != 0; }

  // The nearest ground on a door's side, along its width.
  void add_side(const world::Exit& exit, const Eigen::Vector2d& towards, std::vector<int>& cells);

  bool is_on_border(int cell) const;

  /// The four cells beside one; -1 beyond the border.
  std::array<int, 4> neighbors(int cell) const;

  static std::vector<int> traced(int cell, const std::vector<int>& before);

  /// The first point in a direction that is not free, nearer than `enough_m`.
  std::optional<Eigen::Vector2d> wall_from(const Eigen::Vector2d& at, const Eigen::Vector2d& along,
                                           double enough_m) const;

  bool keeps_all(const Cells& seen, const Cells& reached) const;

  const Routes& routes_;
  Cells free_;
  Cells closed_;             ///< `free_` when all exits are closed and nothing else is
  std::vector<int> inner_;   ///< cells before the open exits
  std::vector<int> outer_;   ///< cells behind them
  std::vector<int> people_;  ///< cells that people start in
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> doors_;
};

}  // namespace throng::scenarios
