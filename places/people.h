// The people of a blueprint and the events that concern them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "world/disasters.h"
#include "world/scenario.h"

namespace throng::places {

/// Activity of a group of people.
enum class Doing {
  stroll,  ///< from spot to spot, pausing at each
  wait,    ///< stand, as an audience does
  cross,   ///< go out by an exit chosen with probability proportional to its width
  leave    ///< go out by the exit that looks fastest
};

/// Orientation of waiting people.
struct Facing {
  enum class Kind { random, direction, towards };
  Kind kind = Kind::random;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< m; of `towards`
  double angle_deg = 0;                             ///< of `direction`, counter-clockwise from +x
  double spread_deg = 10;                           ///< standard deviation about it
};

/// People who are there from the start, spread over an area.
struct Group {
  Doing doing = Doing::stroll;
  std::vector<Eigen::Vector2d> area;  ///< m
  int count = 0;
  Facing facing = {};  ///< of those who wait
};

/// People who stand in line.
struct Line {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< its head, m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  int count = 0;
  std::optional<Facing> facing = std::nullopt;  ///< nothing: to the line's head
};

/// People who come: at an exit, from outside, or at places along a segment.
struct Source {
  Doing doing = Doing::cross;
  std::optional<std::size_t> exit;  ///< index: where they come in
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double per_minute = 0;
  double until_s = 600;
  std::vector<std::pair<double, int>> table;  ///< seconds and people, instead of per_minute
  std::optional<std::size_t> towards;         ///< index of the exit they go to
};

/// A disaster and what it does to the crowd.
struct Danger {
  world::Disaster seen;
  double noticed_m = 15;         ///< from how far people notice it when it starts
  double notice_growth_mps = 1;  ///< how fast the news spreads
  double blocked_m = 0;          ///< nobody who has noticed it goes nearer than this
  bool panic = false;            ///< who flees panics, and others catch it
  double hurts_m = 0;            ///< people within this become casualties
  double hurts_after_s = 0;      ///< so long must one have been within, in all
};

struct People {
  std::vector<Group> groups;
  std::vector<Line> lines;
  std::vector<Source> sources;
  std::vector<Eigen::Vector2d> spots;  ///< where strollers go
  double speed_mps = 1.34;             ///< mean of the free speed
  double in_groups = 0.5;              ///< share of people who walk in social groups
  std::vector<Danger> dangers;
};

/// Reads "people" and "disasters" of a blueprint whose exits are known.
People read_people(const world::JsonValue& people, const world::JsonValue& disasters,
                   const std::vector<world::Exit>& exits);

}  // namespace throng::places
