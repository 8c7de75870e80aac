#include "validation/calm.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/geometry/angle.h"
#include "validation/flow.h"
#include "validation/run.h"
#include "validation/walking.h"

namespace throng::validation {

namespace {

constexpr double kFromS = 20;
constexpr double kUntilS = 60;

TestScene watched_scene(WatchedScene scene) {
  switch (scene) {
    case WatchedScene::queue:
      return room_with_door({0.8, 0.2, 150});
    case WatchedScene::open_square:
      return square_scene(1);
    case WatchedScene::sparse_square:
      return square_scene(0.5);
    case WatchedScene::counter_flow:
      break;
  }
  return two_rooms(100);
}

/// Follows the headings of all people.
class Headings {
 public:
  explicit Headings(const crowd::Simulation& crowd)
      : last_(crowd.yaws_rad().begin(), crowd.yaws_rad().end()),
        wayward_(last_.size(), 0),
        ways_(last_.size()),
        settled_s_(last_.size(), 0) {}

  void look(const crowd::Simulation& crowd) {
    constexpr float kSlowMps = 0.2F;
    for (std::size_t i = 0; i < last_.size(); ++i) {
      const float yaw = crowd.yaws_rad()[i];
      if (crowd.present()[i] != 0) {
        seconds_ += crowd.dt_s();
        count_turn(crowd, i, yaw);
        if (crowd.velocities()[i].norm() < kSlowMps) {
          const double rate = geometry::turn_rad(last_[i], yaw) / crowd.dt_s();
          rate_squares_ += rate * rate;
          ++slow_samples_;
        }
      }
      last_[i] = yaw;
    }
  }

  double turns_per_minute() const { return seconds_ > 0 ? 60 * turns_ / seconds_ : 0; }
  double slow_rate_deg_s() const {
    return slow_samples_ > 0 ? std::sqrt(rate_squares_ / slow_samples_) / kDegree : 0;
  }

 private:
  void count_turn(const crowd::Simulation& crowd, std::size_t i, float yaw) {
    constexpr float kOtherGoal = 0.8F;  // rad: the preferred direction changes by more
    constexpr double kSettleS = 3;      // in which people turn to it
    constexpr float kTurn = 1.5708F;    // rad
    const Eigen::Vector2f wanted = crowd.preferred_velocity(i);
    if (wanted.isZero()) return;
    const float way = std::atan2(wanted.y(), wanted.x());
    if (std::abs(geometry::turn_rad(ways_[i], way)) > kOtherGoal) {
      settled_s_[i] = crowd.time_s() + kSettleS;
      ways_[i] = way;
    }
    const bool wayward = std::abs(geometry::turn_rad(way, yaw)) > kTurn;
    if (wayward && wayward_[i] == 0 && crowd.time_s() > settled_s_[i]) ++turns_;
    wayward_[i] = wayward ? 1 : 0;
  }

  std::vector<float> last_;
  std::vector<std::uint8_t> wayward_;  // 1: faces away from the way
  std::vector<float> ways_;            // since they have changed much
  std::vector<double> settled_s_;      // until then people turn to another goal
  double seconds_ = 0;
  double turns_ = 0;
  double rate_squares_ = 0;  // rad^2/s^2
  double slow_samples_ = 0;
};

}  // namespace

CalmRun watch(const Tested& tested, WatchedScene scene, std::uint64_t seed) {
  crowd::Simulation crowd = load(watched_scene(scene), tested, seed);
  CalmRun run;
  const auto step = [&] {
    crowd.step();
    run.overlap_m = std::max(run.overlap_m, deepest_overlap_m(crowd));
  };
  while (crowd.time_s() < kFromS) step();
  Headings headings(crowd);
  while (crowd.time_s() < kUntilS) {
    step();
    headings.look(crowd);
  }
  run.turns = headings.turns_per_minute();
  run.slow_yaw_rate_deg_s = headings.slow_rate_deg_s();
  return run;
}

}  // namespace throng::validation
