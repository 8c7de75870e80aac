#include "world/clutter/sitters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "world/stand_seats.h"

namespace throng::world {

using Eigen::Vector2d;

namespace {

constexpr std::uint64_t kSitting = std::uint64_t{1} << 44;  // apart from other uses of the stream
constexpr std::uint64_t kSeatsOfProp = 64;                  // more than any kind has
constexpr double kTorsoM = 0.15;                            // around the pelvis
constexpr double kKneesM = 0.45;                            // from there ahead
constexpr double kSitterBucketM = 16;

/// Buildings and props, which nobody may sit in, by place.
class Obstacles {
 public:
  explicit Obstacles(const Scenario& scenario) {
    for (const Building& building : scenario.buildings) {
      if (building.footprint.size() >= 3) add(building.footprint, kNoProp);
    }
    for (std::size_t i = 0; i < scenario.props.size(); ++i) {
      if (prop_type(scenario.props[i].kind).foot == Foot::posts) continue;
      const auto corners = prop_footprint(scenario.props[i]);
      add({corners.begin(), corners.end()}, i);
    }
  }

  /// Whether any but the prop itself is within a distance of a point.
  bool is_near(const Vector2d& point, double distance_m, std::size_t own) const {
    const auto found = buckets_.find(bucket(point));
    return found != buckets_.end() &&
           std::any_of(found->second.begin(), found->second.end(), [&](std::size_t i) {
             return outlines_[i].prop != own &&
                    geometry::distance_to(outlines_[i].corners, point) < distance_m;
           });
  }

 private:
  static constexpr std::size_t kNoProp = static_cast<std::size_t>(-1);
  struct Outline {
    std::vector<Vector2d> corners;
    std::size_t prop;
  };

  static std::int64_t key(std::int64_t x, std::int64_t y) { return (x << 32) + y; }
  static std::int64_t bucket(const Vector2d& point) {
    return key(static_cast<std::int64_t>(std::floor(point.x() / kSitterBucketM)),
               static_cast<std::int64_t>(std::floor(point.y() / kSitterBucketM)));
  }

  void add(std::vector<Vector2d> corners, std::size_t prop) {
    const auto [low, high] = geometry::bounding_box(corners);
    const auto at = [](double m) {
      return static_cast<std::int64_t>(std::floor(m / kSitterBucketM));
    };
    for (std::int64_t x = at(low.x() - kTorsoM); x <= at(high.x() + kTorsoM); ++x) {
      for (std::int64_t y = at(low.y() - kTorsoM); y <= at(high.y() + kTorsoM); ++y) {
        buckets_[key(x, y)].push_back(outlines_.size());
      }
    }
    outlines_.push_back({std::move(corners), prop});
  }

  std::vector<Outline> outlines_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> buckets_;
};

}  // namespace

std::vector<Sitter> free_seats(const Scenario& scenario) {
  const Obstacles obstacles(scenario);
  std::vector<Sitter> seats;
  for (std::size_t i = 0; i < scenario.props.size(); ++i) {
    const Prop& prop = scenario.props[i];
    const Eigen::Rotation2Dd turn(prop.yaw_rad);
    for (const PropSeat& seat : prop_seats(prop.kind)) {
      Sitter sitter;
      sitter.prop = i;
      sitter.position = prop.position + prop.scale * (turn * seat.position);
      sitter.yaw_rad = prop.yaw_rad + seat.yaw_rad;
      sitter.floor_m = prop.scale * seat.height_m - kSeatHeightM;
      const Vector2d ahead(std::cos(sitter.yaw_rad), std::sin(sitter.yaw_rad));
      // On a seat much higher or lower than usual the feet would not be on the ground.
      constexpr double kMaxStepM = 0.1;
      if (std::abs(sitter.floor_m) > kMaxStepM || obstacles.is_near(sitter.position, kTorsoM, i) ||
          obstacles.is_near(sitter.position + kKneesM * ahead, kTorsoM, i)) {
        continue;
      }
      seats.push_back(sitter);
    }
  }
  return seats;
}

void seat_people(const Sitters& sitters, Scenario& scenario) {
  scenario.sitters.clear();
  if (sitters.share <= 0) return;
  const std::vector<Sitter> seats = free_seats(scenario);
  using Ticket = std::pair<double, std::size_t>;  // the higher the later, and for which seat
  std::vector<Ticket> tickets;
  std::size_t of_prop = 0;
  for (std::size_t i = 0; i < seats.size(); ++i) {
    of_prop = i > 0 && seats[i].prop == seats[i - 1].prop ? of_prop + 1 : 0;
    const auto uniform = [&](std::uint64_t number) {
      return Random(sitters.seed, Stream::spectators, kSitting + number).uniform();
    };
    // Companions: a bench or a table is rather full or empty than half taken.
    const std::uint64_t first = seats[i].prop * kSeatsOfProp;
    tickets.emplace_back(0.6 * uniform(first) + 0.4 * uniform(first + 1 + of_prop), i);
  }
  std::sort(tickets.begin(), tickets.end());
  tickets.resize(static_cast<std::size_t>(
      std::lround(std::min(1.0, sitters.share) * static_cast<double>(seats.size()))));
  std::sort(tickets.begin(), tickets.end(),
            [](const Ticket& a, const Ticket& b) { return a.second < b.second; });
  for (const auto& [number, seat] : tickets) scenario.sitters.push_back(seats[seat]);
}

}  // namespace throng::world
