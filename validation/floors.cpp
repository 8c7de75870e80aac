#include "validation/floors.h"

#include <algorithm>
#include <cmath>

#include "validation/criteria.h"
#include "validation/flow.h"
#include "validation/run.h"

namespace throng::validation {

using Eigen::Vector2d;

namespace {

constexpr double kWallM = 0.2;
constexpr std::uint64_t kFloorSeed = 1;

/// One wall with its doors: boxes along it between `from` and `to`.
void add_wall(Side side, double width, double height, const std::vector<Door>& doors,
              std::vector<Polygon>& walls) {
  const bool upright = side == Side::left || side == Side::right;
  std::vector<Door> here;
  std::copy_if(doors.begin(), doors.end(), std::back_inserter(here),
               [&](const Door& door) { return door.side == side; });
  std::sort(here.begin(), here.end(), [](const Door& a, const Door& b) { return a.at_m < b.at_m; });
  const double length = upright ? height : width + kWallM;
  const auto piece = [&](double from, double to) {
    const double low = side == Side::left || side == Side::bottom ? -kWallM
                       : upright                                  ? width
                                                                  : height;
    walls.push_back(upright ? box(low, from, low + kWallM, to) : box(from, low, to, low + kWallM));
  };
  double from = upright ? 0 : -kWallM;
  for (const Door& door : here) {
    piece(from, door.at_m - door.width_m / 2);
    from = door.at_m + door.width_m / 2;
  }
  piece(from, length);
}

bool within(const Eigen::Vector2f& p, double min_x, double min_y, double max_x, double max_y) {
  constexpr double kRounding = 1e-3;  // m
  return p.x() >= min_x - kRounding && p.x() <= max_x + kRounding && p.y() >= min_y - kRounding &&
         p.y() <= max_y + kRounding;
}

/// The mean speed of a single file in m/s: so many people in a ring of 26 m, from 20 s to 80 s.
double file_speed(const Tested& tested, std::size_t people, const Sampled& speed) {
  crowd::Simulation crowd = load(ring({26 / (2 * M_PI), 0.8, people, speed}), tested, kFloorSeed);
  return mean_ring_speed(crowd, 20, 80);
}

}  // namespace

std::vector<Polygon> room(double width, double height, const std::vector<Door>& doors) {
  std::vector<Polygon> walls;
  for (const Side side : {Side::left, Side::right, Side::bottom, Side::top}) {
    add_wall(side, width, height, doors, walls);
  }
  return walls;
}

crowd::Node exit_goal(int id, double x, double y) {
  return describe::box_goal(id, {x - 0.5, y - 0.5}, {x + 0.5, y + 0.5});
}

Corridor walk_corridor(const Tested& tested, double speed_mps) {
  TestScene scene;
  scene.walls = {box(-3, -2, 46, -1), box(-3, 1, 46, 2)};
  Group group;
  group.places = {Vector2d(0, 0)};
  group.aside_m = 0;
  group.speed = Sampled::constant(speed_mps);
  scene.groups = {group};
  scene.behavior.goal_box(0, 42, -0.5, 43, 0.5).walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, kFloorSeed);
  Corridor walk;
  until_all_left(crowd, 200, [&](const crowd::Simulation& now) {
    const Eigen::Vector2f p = now.positions()[0];
    walk.inside = walk.inside && within(p, -1, -1, 50, 1);
    if (walk.time_s == 0 && p.x() >= 40) walk.time_s = now.time_s();
  });
  return walk;
}

std::vector<double> walk_alone(const Tested& tested, const Sampled& speed, std::size_t people) {
  TestScene scene;
  Group group;
  for (std::size_t i = 0; i < people; ++i)
    group.places.emplace_back(0, 20.0 * static_cast<double>(i));
  group.speed = speed;
  scene.groups = {group};
  scene.behavior.add_state("Walk", {describe::velocity("const_dir", {{"x", 1}, {"y", 0}})});
  crowd::Simulation crowd = load(scene, tested, kFloorSeed);
  constexpr double kBegin = 10;  // s; by then everybody is as fast as they will be
  constexpr double kEnd = 30;    // s
  constexpr double kRounding = 1e-6;
  while (crowd.time_s() < kBegin - kRounding) crowd.step();
  const std::vector<Eigen::Vector2f> begin(crowd.positions().begin(), crowd.positions().end());
  while (crowd.time_s() < kEnd - kRounding) crowd.step();
  std::vector<double> speeds;
  speeds.reserve(people);
  for (std::size_t i = 0; i < people; ++i) {
    speeds.push_back((crowd.positions()[i] - begin[i]).norm() / (kEnd - kBegin));
  }
  return speeds;
}

std::vector<int> exits_used(crowd::Simulation& crowd, const std::vector<Vector2d>& exits,
                            double max_s) {
  std::vector<int> used(exits.size(), 0);
  std::vector<std::uint8_t> present(crowd.present().begin(), crowd.present().end());
  until_all_left(crowd, max_s, [&](const crowd::Simulation& now) {
    for (std::size_t i = 0; i < present.size(); ++i) {
      if (present[i] == 0 || now.present()[i] != 0) continue;
      present[i] = 0;
      const Vector2d place = now.positions()[i].cast<double>();
      const auto nearest =
          std::min_element(exits.begin(), exits.end(), [&](const Vector2d& a, const Vector2d& b) {
            return (a - place).squaredNorm() < (b - place).squaredNorm();
          });
      ++used[static_cast<std::size_t>(nearest - exits.begin())];
    }
  });
  return used;
}

Verdict round_corner(const Tested& tested, double max_s) {
  TestScene scene;
  scene.walls = {box(-11, -1, 3, 0), box(-11, 2, 0, 13), box(2, 0, 3, 13)};
  Group group;
  group.places = lattice({-10, 0.25}, {-4, 1.75}, 20);
  scene.groups = {group};
  scene.behavior.goal_box(0, 0.5, 11, 1.5, 12).walk_to(0).leave_at_goal();
  crowd::Simulation crowd = load(scene, tested, kFloorSeed);
  long outside = 0;
  const auto end = until_all_left(crowd, 300, [&](const crowd::Simulation& now) {
    for (std::size_t i = 0; i < now.agent_count(); ++i) {
      const Eigen::Vector2f& p = now.positions()[i];
      if (now.present()[i] != 0 && !within(p, -11, 0, 2, 2) && !within(p, 0, 0, 2, 13)) ++outside;
    }
  });
  return criteria::corner_walk(end, outside, max_s);
}

Verdict assigned_exits(const Tested& tested, Effort) {
  // Six rooms of 5 m x 5 m on both sides of a corridor from (0, 0) to (30, 2), open at both ends.
  constexpr int kRooms = 6;
  constexpr double kRoom = 5;
  TestScene scene;
  Group main;
  main.state = "Main";
  Group other = main;
  other.state = "Other";
  int people = 0;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < kRooms; ++i) {
      const bool above = row == 1;
      for (Polygon wall :
           room(kRoom - 0.2, kRoom, {{above ? Side::bottom : Side::top, kRoom / 2, 0.9}})) {
        const Vector2d shift(i * kRoom + 0.1, above ? 2.2 : -kRoom - 0.2);
        for (Vector2d& corner : wall) corner += shift;
        scene.walls.push_back(wall);
      }
      for (int k = 0; k < 2 && people < 23; ++k, ++people) {
        (i < 4 ? main : other).places.emplace_back(i * kRoom + 1.5 + 2 * k, above ? 5 : -3);
      }
    }
  }
  scene.groups = {main, other};
  scene.behavior.add_goal_set(0, {exit_goal(0, -2, 1), exit_goal(1, 32, 1)});
  scene.behavior.add_state("Main", {describe::select_goal(0, 0), describe::velocity("auto")});
  scene.behavior.add_state("Other", {describe::select_goal(0, 1), describe::velocity("auto")});
  scene.behavior.leave_at_goal("Main,Other");
  crowd::Simulation crowd = load(scene, tested, kFloorSeed);
  const std::vector<int> used = exits_used(crowd, {Vector2d(-2, 1), Vector2d(32, 1)}, 600);
  return criteria::exit_assignment({used[0], used[1]}, {static_cast<int>(main.places.size()),
                                                        static_cast<int>(other.places.size())});
}

Verdict single_file(const Tested& tested, Effort effort) {
  const std::vector<std::size_t> numbers =
      effort == Effort::full ? std::vector<std::size_t>{10, 14, 18, 22, 26, 30, 35, 40}
                             : std::vector<std::size_t>{14, 22, 30};
  std::vector<criteria::FileSpeeds> files;
  files.reserve(numbers.size());
  for (const std::size_t people : numbers) {
    files.push_back({people, file_speed(tested, people, Sampled::constant(1.34)),
                     file_speed(tested, people, Sampled::constant(0.8)),
                     file_speed(tested, people, Sampled::constant(1.6))});
  }
  return criteria::single_file_speeds(files);
}

}  // namespace throng::validation
