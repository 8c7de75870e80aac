// People on stands and on seats of props: their height above the ground and their postures along a
// trace.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skinning/animate/spectator_pose.h"
#include "skinning/appearance.h"
#include "world/props.h"
#include "world/stand.h"
#include "world/trace.h"

namespace throng::render {

/// The stands and the seats of a scenario, to find how high people are.
class StandFloors {
 public:
  explicit StandFloors(std::span<const world::Stand> stands,
                       std::span<const world::Sitter> sitters = {});
  /// Height of the floor (m): of a stand's, or world::Sitter::floor_m on a seat; 0 elsewhere.
  float height_m(const Eigen::Vector2f& point) const;

 private:
  std::vector<world::Stand> stands_;
  std::vector<Eigen::AlignedBox2d> boxes_;  ///< around each stand
  std::vector<Eigen::Vector3d> seats_;      ///< with their floors, by x
};

/// The kind of place at which an agent is seen, on which its appearance depends.
skinning::Spot find_spot(const world::TraceHeader& header, std::size_t agent);

/// The posture that each state of a trace stands for; nothing if people in it walk.
std::vector<std::optional<skinning::StandPosture>> stand_postures(const world::TraceHeader& header);

/// The postures of a trace's people.
class PeopleOnStands {
 public:
  PeopleOnStands(const world::Trace& trace, std::span<const world::Stand> stands,
                 std::span<const world::Sitter> sitters);

  /// Whether an agent has a posture at a step.
  bool has_posture(std::size_t agent, std::size_t step) const;
  const StandFloors& floors() const { return floors_; }
  /// The posture of an agent at a time, if it has one at the step before.
  std::optional<skinning::PostureTime> posture_at(std::size_t agent, std::size_t step,
                                                  double time_s) const;

 private:
  /// A posture from a step on; nothing: walks, or is absent.
  struct Change {
    std::uint32_t step = 0;
    std::optional<skinning::StandPosture> posture;
  };

  const world::Trace* trace_;
  StandFloors floors_;
  std::vector<std::vector<Change>> changes_;  ///< per agent; empty for those never on a stand
};

}  // namespace throng::render
