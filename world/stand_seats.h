// Rows, aisles, openings and seats of a stand: the one layout that its geometry, its spectators and
// their elevation follow. A stand's frame: `along` from its end `from` to `to`, `back` from the
// front edge away from the field, which is to the right of from -> to (m).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "world/props.h"
#include "world/stand.h"

namespace throng::world {

inline constexpr double kAisleWidthM = 1.2;
inline constexpr double kSeatSpacingM = 0.5;
/// From the middle of a sitter's pelvis to the rear edge of the row.
inline constexpr double kSeatToRearM = 0.25;
/// Height of a seat above the floor of its row, on which people sit (skinning's kSeatM).
inline constexpr double kSeatHeightM = 0.44;
/// Width of a vomitory, an opening through which people come from below, and its rows.
inline constexpr double kVomitoryWidthM = 2.4;
inline constexpr int kVomitoryFirstRow = 4;
inline constexpr int kVomitoryRows = 4;
/// Depth of the steps from the ground in front of an aisle up to the first row.
inline constexpr double kFrontStepsM = 0.6;

/// Stairs through all rows.
struct Aisle {
  double along_m = 0;  ///< its middle
};

/// An opening in an aisle: no floor and no seats in these rows.
struct Vomitory {
  std::size_t aisle = 0;  ///< index into aisles()
  double along_m = 0;     ///< its middle
  int first_row = 0;
  int end_row = 0;  ///< the row behind its last one
};

/// One seat.
struct Seat {
  int row = 0;
  int block = 0;  ///< between aisles, counted from `from`
  double along_m = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< below the sitter's pelvis (m)
  double height_m = 0;                                 ///< of the row's floor
};

/// Length of the front edge (m).
double length_m(const Stand& stand);
/// Depth of all rows (m).
double depth_m(const Stand& stand);
/// The point of the ground plane at these coordinates of the stand's frame.
Eigen::Vector2d point_on(const Stand& stand, double along_m, double back_m);
/// The coordinates (along, back) of a point.
Eigen::Vector2d frame_point(const Stand& stand, const Eigen::Vector2d& point);
/// Corners of the ground that the rows cover, counter-clockwise (m).
std::array<Eigen::Vector2d, 4> stand_outline(const Stand& stand);
/// The heading of somebody who faces the field.
double facing_rad(const Stand& stand);
/// How far a spectator who stands is ahead of where the same one sits, in rows deep enough (m).
inline constexpr double kStandingAheadM = 0.3;
/// The same in the rows of a stand.
double standing_ahead_m(const Stand& stand);
/// Height of a row's floor (m).
double row_height_m(const Stand& stand, int row);

/// The aisles in the order of along_m: one at each end and between blocks of about 11 m of equal
/// length. A stand below 3.4 m has only the one at `from`.
std::vector<Aisle> aisles(const Stand& stand);
/// The aisles between blocks, which can have vomitories.
std::size_t inner_aisles(const Stand& stand);
/// The vomitories in the order of along_m: evenly spaced, moved into the nearest inner aisle. None
/// in stands of four rows or fewer.
std::vector<Vomitory> vomitories(const Stand& stand);
/// The deck of a main stage, on which its band stands; nothing for other props.
std::optional<Stand> stage_deck(const Prop& prop);
/// All seats, by row and then along. None where vomitories are. The band's places on a deck.
std::vector<Seat> seats(const Stand& stand);
/// The seats of the spectators, a sample by their seed, as indices into `seats` in ascending order:
/// more in groups than alone, in the middle than at the ends. A larger count contains every smaller
/// one.
std::vector<std::size_t> taken_seats(const Stand& stand, std::span<const Seat> seats);

/// Height of the floor at a point (m): of the row's tread, of the slope of an aisle, which passes
/// through the middle of every tread, or of the steps before an aisle, or of the nearest of
/// a band's places within 1 m; 0 outside of them.
double elevation_m(std::span<const Stand> stands, const Eigen::Vector2d& point);

}  // namespace throng::world
