// The shipped scenario does what its story says.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

constexpr std::size_t kPeople = 260;
constexpr double kNewsTime = 18;  // s

struct Building {
  float min_x, min_y, max_x, max_y;
};
constexpr std::array<Building, 5> kBuildings = {{{-15, 18, 19, 22},
                                                 {-20, -23, 20, -17},
                                                 {22, -20, 28, 20},
                                                 {-19, -15, -13, -1},
                                                 {-19, 1, -13, 15}}};

/// How far inside a building a point is; negative outside.
float depth_in_buildings(const Eigen::Vector2f& p) {
  float depth = -1e9F;
  for (const Building& b : kBuildings) {
    depth = std::max(
        depth, std::min({p.x() - b.min_x, b.max_x - p.x(), p.y() - b.min_y, b.max_y - p.y()}));
  }
  return depth;
}

bool has_escaped(const Eigen::Vector2f& p) { return std::abs(p.x()) > 30 || std::abs(p.y()) > 40; }

TEST(CitySquare, EveryoneGetsOutByAllExits) {
  for (const std::uint64_t seed : {1, 2}) {
    Simulation crowd = test::load_city_square(seed);
    ASSERT_EQ(crowd.agent_count(), kPeople + 1);
    const std::vector<std::string> names = crowd.state_names();
    const auto is_strolling = [&](std::size_t i) {
      return names[crowd.states()[i]] == "Walk" || names[crowd.states()[i]] == "Wait";
    };
    std::vector<int> exit_of(kPeople, -1);
    std::size_t moving_before = 0;
    while (crowd.time_s() < kNewsTime + 120) {
      crowd.step();
      std::size_t strolling = 0;
      for (std::size_t i = 0; i < kPeople; ++i) {
        const Eigen::Vector2f p = crowd.positions()[i];
        ASSERT_TRUE(p.allFinite());
        if (crowd.time_s() > 1) {
          ASSERT_LT(depth_in_buildings(p), 0.05F) << "agent " << i;
        }
        if (crowd.goals()[i].set == 4) exit_of[i] = crowd.goals()[i].goal;
        if (is_strolling(i)) ++strolling;
        if (crowd.velocities()[i].norm() > 0.5F) ++moving_before;
      }
      if (crowd.time_s() <= kNewsTime) {
        EXPECT_EQ(strolling, kPeople);
      }
      if (crowd.time_s() > kNewsTime + 19) {
        EXPECT_EQ(strolling, 0U) << crowd.time_s();
      }
      EXPECT_EQ(crowd.positions()[kPeople], Eigen::Vector2f(20, 0)) << "the disaster stays";
    }
    EXPECT_GT(moving_before, 0U);
    const auto escaped =
        std::count_if(crowd.positions().begin(), crowd.positions().begin() + kPeople, has_escaped);
    EXPECT_GE(escaped, static_cast<long>(0.98 * kPeople)) << "seed " << seed;
    std::map<int, int> used;
    for (const int exit : exit_of) ++used[exit];
    for (const int exit : {0, 1, 2, 3, 4}) {
      EXPECT_GE(used[exit], 5) << "exit goal " << exit;
      if (exit != 1) {
        EXPECT_GT(used[1], used[exit]) << "the middle exit is the busiest";
      }
    }
  }
}

TEST(CitySquare, PeopleFollowTheGuide) {
  Simulation crowd = test::load_city_square(3);
  crowd.move_goal(99, 0, {-8, 0});  // before the crowded middle exit
  std::size_t max_followers = 0;
  while (crowd.time_s() < 60) {
    crowd.step();
    std::size_t followers = 0;
    for (std::size_t i = 0; i < kPeople; ++i) {
      if (crowd.goals()[i].set == 99) ++followers;
    }
    max_followers = std::max(max_followers, followers);
  }
  EXPECT_GT(max_followers, 20U);
}

TEST(CitySquare, NobodyGetsStuckBehindABuilding) {
  for (const std::uint64_t seed : {1, 2}) {
    Simulation crowd = test::load_city_square(seed);
    // The guide leaves the middle exit, flies over a building and waits behind it.
    const Eigen::Vector2f waiting(-26, -8);
    while (crowd.time_s() < 160) {
      const auto flown = static_cast<float>(std::max(0.0, crowd.time_s() - 16));
      const Eigen::Vector2f guide(std::clamp(-7 - (flown - 7), waiting.x(), -7.0F),
                                  std::max(-1 - flown, waiting.y()));
      crowd.move_goal(99, 0, guide);
      crowd.step();
    }
    for (std::size_t i = 0; i < kPeople; ++i) {
      const Eigen::Vector2f p = crowd.positions()[i];
      EXPECT_TRUE(has_escaped(p) || (p - waiting).norm() < 5)
          << "seed " << seed << ", agent " << i << " at " << p.transpose() << " in state "
          << test::state_name(crowd, i);
    }
  }
}

}  // namespace
}  // namespace throng::crowd
