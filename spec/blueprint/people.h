// The people of a blueprint and the disasters that affect them; see people_fields.h.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spec/blueprint/sampled_value.h"
#include "world/disasters.h"

namespace throng::scenarios {

/// Activity of a group of people.
enum class Doing {
  stroll,  ///< walk from spot to spot, with a pause at each
  wait,    ///< stand
  cross,   ///< leave by an exit sampled with probability proportional to its width
  leave,   ///< leave by the exit that appears fastest
  watch    ///< stand and watch a show: clap, cheer, film, dance
};

/// Whether people who do this stand where they are and may face a direction.
constexpr bool stays(Doing doing) { return doing == Doing::wait || doing == Doing::watch; }

/// Orientation of waiting people.
struct Facing {
  enum class Kind { random, direction, towards };
  Kind kind = Kind::random;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< for `towards`, m
  double angle_deg = 0;                             ///< for `direction`, counter-clockwise from +x
  double spread_deg = 10;                           ///< standard deviation about the direction
};

/// People who are present from the start, distributed over an area.
struct Group {
  Doing doing = Doing::stroll;
  std::vector<Eigen::Vector2d> area;  ///< m
  int count = 0;
  Facing facing = {};                                    ///< for waiting people
  std::optional<SampledValue> speed_mps = std::nullopt;  ///< free speed; nothing: People::speed_mps
};

/// People who stand in a line.
struct Line {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< head of the line, m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  int count = 0;
  std::optional<Facing> facing = std::nullopt;           ///< nothing: toward the head
  std::optional<SampledValue> speed_mps = std::nullopt;  ///< free speed; nothing: People::speed_mps
};

/// People who arrive: from outside by an exit, or at points of a segment.
struct Source {
  Doing doing = Doing::cross;
  std::string exit_id;              ///< exit by which they enter; empty: along the segment
  std::string towards_id;           ///< exit for which they head; empty: none
  std::optional<std::size_t> exit;  ///< index of the exit by which they enter
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double per_minute = 0;
  double until_s = 600;
  /// Times (s) and numbers of people, instead of per_minute.
  std::vector<std::pair<double, int>> table;
  std::optional<std::size_t> towards;                    ///< index of the exit for which they head
  std::optional<std::size_t> of_stand = std::nullopt;    ///< index of the stand that they leave
  std::optional<SampledValue> speed_mps = std::nullopt;  ///< free speed; nothing: People::speed_mps
};

/// A disaster and its effects on the crowd.
struct Danger {
  world::Disaster seen;
  double noticed_m = 15;         ///< distance within which people notice it at its start
  double notice_growth_mps = 1;  ///< growth of this distance
  double blocked_m = 0;          ///< distance that people who have noticed it keep
  bool panic = false;            ///< fleeing people panic, and the panic spreads to others
  double hurts_m = 0;            ///< distance within which people become casualties
  double hurts_after_s = 0;      ///< total time within this distance until then
};

/// All people of a blueprint.
struct People {
  std::vector<Group> groups;
  std::vector<Line> lines;
  std::vector<Source> sources;
  std::vector<Eigen::Vector2d> spots;  ///< destinations of strolling people, m
  SampledValue speed_mps = SampledValue::normal(1.34, 0.255);  ///< free speed (Weidmann 1993)
  /// Pre-movement time (s), from noticing a disaster until the start of movement. The default is an
  /// assumption without a source; studies should set their own.
  SampledValue pre_movement_s = {SampledValue::Kind::lognormal, 0.7, 0.5,
                                 -std::numeric_limits<double>::infinity(), 6};
  /// Free speed of fleeing people; nothing: unchanged. The default assumes that they run.
  std::optional<SampledValue> evacuation_speed_mps = SampledValue::normal(2, 0.25);
  double in_groups = 0.5;  ///< share of people who walk in social groups
  std::vector<Danger> dangers;
};

}  // namespace throng::scenarios
