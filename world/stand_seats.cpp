#include "world/stand_seats.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/compute/random.h"

namespace throng::world {

using Eigen::Vector2d;

namespace {

constexpr double kBlockM = 11;
constexpr double kTwoAislesM = 3.4;  // shorter stands have one
constexpr double kSeatSlackM = 1e-9;
/// Neighbors who come together.
constexpr double kGroupM = 2;
constexpr int kGroupRows = 2;
constexpr std::uint64_t kGroups = std::uint64_t{1} << 40;  // apart from the seats in the stream

/// Number of blocks and their length (m).
struct Blocks {
  int count = 1;
  double length_m = 0;
};

bool has_end_aisle(double stand_m) { return stand_m >= kTwoAislesM; }

Blocks block_layout(const Stand& stand) {
  const double stand_m = length_m(stand);
  if (!has_end_aisle(stand_m)) return {1, stand_m - kAisleWidthM};
  const double rest_m = stand_m - kAisleWidthM;
  const int count = std::max(1, static_cast<int>(std::lround(rest_m / (kBlockM + kAisleWidthM))));
  return {count, rest_m / count - kAisleWidthM};
}

Vector2d along_axis(const Stand& stand) { return (stand.to - stand.from).normalized(); }

Vector2d back_axis(const Stand& stand) {
  const Vector2d along = along_axis(stand);
  return {along.y(), -along.x()};
}

bool is_open(std::span<const Vomitory> openings, int row, double along_m) {
  return std::any_of(openings.begin(), openings.end(), [&](const Vomitory& opening) {
    return row >= opening.first_row && row < opening.end_row &&
           std::abs(along_m - opening.along_m) <
               0.5 * (kVomitoryWidthM + kSeatSpacingM) - kSeatSlackM;
  });
}

bool is_in_aisle(const Stand& stand, double along_m) {
  const Blocks blocks = block_layout(stand);
  const double at_m = std::fmod(along_m, blocks.length_m + kAisleWidthM);
  return at_m <= kAisleWidthM;
}

double aisle_height_m(const Stand& stand, double back_m) {
  const double row = std::clamp(back_m / stand.row_depth_m - 0.5, 0.0, stand.rows - 1.0);
  return stand.front_height_m + row * stand.row_rise_m;
}

/// Height below the nearest place of a band.
std::optional<double> height_on_deck(const Stand& deck, const Vector2d& point) {
  constexpr double kReachM = 1;
  const auto off_m = [&](const Eigen::Vector3d& place) { return (place.head<2>() - point).norm(); };
  const auto nearest =
      std::min_element(deck.band.begin(), deck.band.end(),
                       [&](const auto& a, const auto& b) { return off_m(a) < off_m(b); });
  if (off_m(*nearest) > kReachM) return std::nullopt;
  return nearest->z();
}

std::optional<double> height_on(const Stand& stand, const Vector2d& point) {
  if (!stand.band.empty()) return height_on_deck(stand, point);
  const Vector2d at = frame_point(stand, point);
  if (at.x() < 0 || at.x() > length_m(stand) || at.y() < -kFrontStepsM || at.y() > depth_m(stand)) {
    return std::nullopt;
  }
  const bool on_stairs = is_in_aisle(stand, at.x());
  if (at.y() < 0) {
    if (!on_stairs) return std::nullopt;
    return stand.front_height_m * (1 + at.y() / kFrontStepsM);
  }
  if (on_stairs) return aisle_height_m(stand, at.y());
  const int row = static_cast<int>(std::floor(at.y() / stand.row_depth_m));
  return row_height_m(stand, std::min(row, stand.rows - 1));
}

}  // namespace

double length_m(const Stand& stand) { return (stand.to - stand.from).norm(); }

double depth_m(const Stand& stand) { return stand.rows * stand.row_depth_m; }

Vector2d point_on(const Stand& stand, double along_m, double back_m) {
  return stand.from + along_m * along_axis(stand) + back_m * back_axis(stand);
}

Vector2d frame_point(const Stand& stand, const Vector2d& point) {
  const Vector2d offset = point - stand.from;
  return {offset.dot(along_axis(stand)), offset.dot(back_axis(stand))};
}

std::array<Vector2d, 4> stand_outline(const Stand& stand) {
  const double along = length_m(stand);
  const double back = depth_m(stand);
  return {point_on(stand, 0, back), point_on(stand, along, back), point_on(stand, along, 0),
          point_on(stand, 0, 0)};
}

double facing_rad(const Stand& stand) {
  const Vector2d front = -back_axis(stand);
  return std::atan2(front.y(), front.x());
}

double standing_ahead_m(const Stand& stand) {
  constexpr double kToEdgeM = 0.2;
  return std::min(kStandingAheadM, stand.row_depth_m - kSeatToRearM - kToEdgeM);
}

double row_height_m(const Stand& stand, int row) {
  return stand.front_height_m + row * stand.row_rise_m;
}

std::vector<Aisle> aisles(const Stand& stand) {
  const Blocks blocks = block_layout(stand);
  const int count = blocks.count + (has_end_aisle(length_m(stand)) ? 1 : 0);
  std::vector<Aisle> found;
  found.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    found.push_back({i * (blocks.length_m + kAisleWidthM) + 0.5 * kAisleWidthM});
  }
  return found;
}

std::size_t inner_aisles(const Stand& stand) {
  return static_cast<std::size_t>(block_layout(stand).count - 1);
}

std::vector<Vomitory> vomitories(const Stand& stand) {
  std::vector<Vomitory> openings;
  const std::vector<Aisle> stairs = aisles(stand);
  const std::size_t inner = inner_aisles(stand);
  if (inner == 0 || stand.rows <= kVomitoryFirstRow) return openings;
  for (int i = 0; i < stand.vomitories; ++i) {
    const double wanted_m = length_m(stand) * (i + 0.5) / stand.vomitories;
    std::size_t nearest = 1;
    for (std::size_t k = 2; k <= inner; ++k) {
      const double nearer_m = std::abs(stairs[nearest].along_m - wanted_m) - kSeatSlackM;
      if (std::abs(stairs[k].along_m - wanted_m) < nearer_m) nearest = k;
    }
    if (!openings.empty() && openings.back().aisle == nearest) continue;
    openings.push_back({nearest, stairs[nearest].along_m, kVomitoryFirstRow,
                        std::min(kVomitoryFirstRow + kVomitoryRows, stand.rows)});
  }
  return openings;
}

std::optional<Stand> stage_deck(const Prop& prop) {
  // Voice, guitar, bass, keyboard, percussion and drums: in the prop's frame, with their floors.
  static const std::vector<Eigen::Vector3d> kBand = {{0, -4.5, 1.6},    {-3.4, -3.5, 1.6},
                                                     {3.4, -3.5, 1.6},  {6.1, 0.5, 1.95},
                                                     {-6.2, 0.5, 1.95}, {0, 3.2, 2.115}};
  if (prop.kind != PropKind::main_stage) return std::nullopt;
  const Eigen::Rotation2Dd turn(prop.yaw_rad);
  const Vector2d half = prop_type(prop.kind).half_size;
  const auto at = [&](const Vector2d& place) -> Vector2d {
    return prop.position + prop.scale * (turn * place);
  };
  Stand deck;
  deck.from = at({half.x(), -half.y()});
  deck.to = at({-half.x(), -half.y()});
  deck.rows = 1;
  deck.row_depth_m = 2 * half.y() * prop.scale;
  for (const Eigen::Vector3d& place : kBand) {
    const Vector2d ground = at(place.head<2>());
    deck.band.emplace_back(ground.x(), ground.y(), prop.scale * place.z());
  }
  deck.spectators.count = static_cast<int>(deck.band.size());
  return deck;
}

std::vector<Seat> seats(const Stand& stand) {
  if (!stand.band.empty()) {
    std::vector<Seat> places;
    for (const Eigen::Vector3d& place : stand.band) {
      places.push_back({0, 0, 0, place.head<2>(), place.z()});
    }
    return places;
  }
  const Blocks blocks = block_layout(stand);
  const std::vector<Vomitory> openings = vomitories(stand);
  const int in_block = static_cast<int>(std::floor(blocks.length_m / kSeatSpacingM + kSeatSlackM));
  const double margin_m = 0.5 * (blocks.length_m - in_block * kSeatSpacingM);
  std::vector<Seat> found;
  for (int row = 0; row < stand.rows; ++row) {
    const double back_m = (row + 1) * stand.row_depth_m - kSeatToRearM;
    for (int block = 0; block < blocks.count; ++block) {
      const double from_m = block * (blocks.length_m + kAisleWidthM) + kAisleWidthM + margin_m;
      for (int i = 0; i < in_block; ++i) {
        const double along_m = from_m + (i + 0.5) * kSeatSpacingM;
        if (is_open(openings, row, along_m)) continue;
        found.push_back(
            {row, block, along_m, point_on(stand, along_m, back_m), row_height_m(stand, row)});
      }
    }
  }
  return found;
}

std::vector<std::size_t> taken_seats(const Stand& stand, std::span<const Seat> seats) {
  using Ticket = std::pair<double, std::size_t>;  // the higher the later, and for which seat
  const double half_m = 0.5 * length_m(stand);
  std::vector<Ticket> tickets;
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const Seat& seat = seats[i];
    const auto group = static_cast<std::uint64_t>(seat.along_m / kGroupM) * 1024 +
                       static_cast<std::uint64_t>(seat.row / kGroupRows);
    const double aside = std::abs(seat.along_m - half_m) / half_m;
    const double behind = static_cast<double>(seat.row) / stand.rows;
    tickets.emplace_back(
        0.4 * Random(stand.spectators.seed, Stream::spectators, kGroups + group).uniform() +
            0.35 * Random(stand.spectators.seed, Stream::spectators, i).uniform() + 0.25 * aside +
            0.1 * behind,
        i);
  }
  std::sort(tickets.begin(), tickets.end());
  const auto count = std::min(static_cast<std::size_t>(stand.spectators.count), tickets.size());
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < count; ++i) taken.push_back(tickets[i].second);
  std::sort(taken.begin(), taken.end());
  return taken;
}

double elevation_m(std::span<const Stand> stands, const Vector2d& point) {
  for (const Stand& stand : stands) {
    if (const std::optional<double> height_m = height_on(stand, point)) return *height_m;
  }
  return 0;
}

}  // namespace throng::world
