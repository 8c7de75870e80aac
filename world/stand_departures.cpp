#include "world/stand_departures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/compute/random.h"

namespace throng::world {

using Eigen::Vector2d;

namespace {

constexpr double kRowMps = 0.6;
constexpr double kAisleMps = 0.7;  // along the slope
constexpr std::uint64_t kReactions = 1;

/// The nearest aisle by which somebody in a row comes down: not through an opening.
std::size_t nearest_aisle(const Seat& seat, const std::vector<Aisle>& stairs,
                          const std::vector<Vomitory>& openings) {
  std::size_t nearest = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < stairs.size(); ++i) {
    const bool is_cut = std::any_of(openings.begin(), openings.end(), [&](const Vomitory& opening) {
      return opening.aisle == i && seat.row >= opening.first_row;
    });
    const double away_m = std::abs(stairs[i].along_m - seat.along_m);
    if (is_cut || away_m >= nearest_m) continue;
    nearest = i;
    nearest_m = away_m;
  }
  return nearest;
}

/// Somebody who wants to leave.
struct Leaver {
  std::size_t spectator = 0;
  std::size_t aisle = 0;
  int row = 0;
  double away_m = 0;      ///< from the aisle
  double ready_s = 0;     ///< could be at the foot
  double duration_s = 0;  ///< of the way
};

}  // namespace

Vector2d aisle_foot(const Stand& stand, const Aisle& aisle) {
  return point_on(stand, aisle.along_m, -kFrontStepsM);
}

WayDown::WayDown(const Stand& stand, const Seat& seat, const Aisle& aisle) {
  const double depth_m = stand.row_depth_m;
  const double seat_m = (seat.row + 1) * depth_m - kSeatToRearM;
  const double middle_m = (seat.row + 0.5) * depth_m;
  const auto add = [&](const Vector2d& to, double lasts_s) {
    const Vector2d from = legs_.empty() ? point_on(stand, seat.along_m, seat_m) : legs_.back().to;
    legs_.push_back({from, to, lasts_s});
  };
  const Vector2d stands_at = point_on(stand, seat.along_m, seat_m - standing_ahead_m(stand));
  add(stands_at, kGetUpS);
  const Vector2d in_row = point_on(stand, seat.along_m, middle_m);
  add(in_row, std::max(0.2, (in_row - stands_at).norm() / kRowMps));
  add(point_on(stand, aisle.along_m, middle_m), std::abs(aisle.along_m - seat.along_m) / kRowMps);
  const double slope_m = seat.row * std::hypot(depth_m, stand.row_rise_m);
  add(point_on(stand, aisle.along_m, 0.5 * depth_m), slope_m / kAisleMps);
  add(point_on(stand, aisle.along_m, 0), 0.5 * depth_m / kAisleMps);
  add(aisle_foot(stand, aisle), std::hypot(kFrontStepsM, stand.front_height_m) / kAisleMps);
}

double WayDown::duration_s() const {
  double sum_s = 0;
  for (const Leg& leg : legs_) sum_s += leg.lasts_s;
  return sum_s;
}

OnTheWay WayDown::at(double time_s) const {
  double left_s = std::max(time_s, 0.0);
  for (const Leg& leg : legs_) {
    if (left_s < leg.lasts_s) {
      const Vector2d way = leg.to - leg.from;
      return {leg.from + left_s / leg.lasts_s * way, way / leg.lasts_s};
    }
    left_s -= leg.lasts_s;
  }
  return {legs_.back().to, Vector2d::Zero()};
}

std::vector<Departure> departures(const Stand& stand) {
  std::vector<Departure> list;
  if (!std::isfinite(stand.spectators.leave_at_s)) return list;
  const std::vector<Seat> all = seats(stand);
  const std::vector<std::size_t> taken = taken_seats(stand, all);
  const std::vector<Aisle> stairs = aisles(stand);
  const std::vector<Vomitory> openings = vomitories(stand);
  const std::uint64_t key = derive_seed(stand.spectators.seed, Stream::spectators, kReactions);
  std::vector<Leaver> leavers;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Seat& seat = all[taken[i]];
    const std::size_t aisle = nearest_aisle(seat, stairs, openings);
    const double duration_s = WayDown(stand, seat, stairs[aisle]).duration_s();
    const double reaction_s = Random(key, Stream::spectators, taken[i]).uniform(1, 8);
    leavers.push_back({i, aisle, seat.row, std::abs(seat.along_m - stairs[aisle].along_m),
                       stand.spectators.leave_at_s + reaction_s + duration_s, duration_s});
  }
  std::sort(leavers.begin(), leavers.end(), [](const Leaver& a, const Leaver& b) {
    return std::tuple(a.aisle, a.row, a.away_m, a.spectator) <
           std::tuple(b.aisle, b.row, b.away_m, b.spectator);
  });
  for (const Leaver& leaver : leavers) {
    double at_foot_s = leaver.ready_s;
    if (!list.empty() && list.back().aisle == leaver.aisle) {
      at_foot_s = std::max(at_foot_s, list.back().at_foot_s + kFootHeadwayS);
    }
    list.push_back({leaver.spectator, leaver.aisle, at_foot_s - leaver.duration_s, at_foot_s});
  }
  return list;
}

}  // namespace throng::world
