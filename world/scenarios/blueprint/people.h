// The people of a blueprint and the events that concern them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "world/disasters.h"
#include "world/scenario.h"
#include "world/scenarios/blueprint/sampled_value.h"

namespace throng::scenarios {

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
  Facing facing = {};                                    ///< of those who wait
  std::optional<SampledValue> speed_mps = std::nullopt;  ///< free speed; nothing: everybody's
};

/// People who stand in line.
struct Line {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< its head, m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  int count = 0;
  std::optional<Facing> facing = std::nullopt;           ///< nothing: to the line's head
  std::optional<SampledValue> speed_mps = std::nullopt;  ///< free speed; nothing: everybody's
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
  std::optional<SampledValue> speed_mps = std::nullopt;  ///< free speed; nothing: everybody's
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
  std::vector<Eigen::Vector2d> spots;                          ///< where strollers go
  SampledValue speed_mps = SampledValue::normal(1.34, 0.255);  ///< free speed (Weidmann 1993)
  /// From when people notice a disaster until they leave, s. An assumption without a source; a
  /// study takes its own.
  SampledValue pre_movement_s = {SampledValue::Kind::lognormal, 0.7, 0.5,
                                 -std::numeric_limits<double>::infinity(), 6};
  /// Free speed of people who flee; nothing: as before. An assumption: they run.
  std::optional<SampledValue> evacuation_speed_mps = SampledValue::normal(2, 0.25);
  double in_groups = 0.5;  ///< share of people who walk in social groups
  std::vector<Danger> dangers;
};

/// Whether anybody leaves by an exit before or without a disaster.
bool anybody_leaves(const People& people);

/// Reads "people" and "disasters" of a blueprint whose exits are known.
People read_people(const world::JsonValue& people, const world::JsonValue& disasters,
                   const std::vector<world::Exit>& exits);

}  // namespace throng::scenarios
