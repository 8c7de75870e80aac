// Formations: relative positions of people who walk together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/elements/text_file.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

/// The positions of a formation whose walking direction is +x.
class Formation {
 public:
  /// Reads a file of numbers: number of border points; x, y and weight of these and of inner
  /// points; x and y of the walking direction. Throws InputError.
  explicit Formation(const TextFile& source);

  /// Positions in m, sorted by weight, the greatest first.
  const std::vector<Eigen::Vector2f>& places() const { return places_; }

 private:
  std::vector<Eigen::Vector2f> places_;
};

/// The members of a formation, their positions in it and their velocity, the mean of their
/// preferred velocities. The center of the formation is that of its members.
class FormationGroup : public Process {
 public:
  FormationGroup(Formation formation, std::size_t agent_count);

  /// Makes the agents that called lead() in the last step members and assigns positions in the
  /// order of their weights, each to the nearest agent without one. Assignments last until an agent
  /// joins or leaves; agents without a position walk alone.
  void before_decisions(Crowd& crowd, Machine& machine) override;

  /// Returns the velocity of an agent in the formation; `alone` is its own preferred velocity.
  /// Called for several agents concurrently.
  PreferredVelocity lead(const Crowd& crowd, std::size_t agent, const PreferredVelocity& alone);

 private:
  static constexpr int kNone = -1;

  bool gather(const Crowd& crowd);
  void take_places(const Crowd& crowd, const Eigen::Vector2f& middle);
  Eigen::Vector2f middle_of_members(const Crowd& crowd) const;
  Eigen::Vector2f turned(const Eigen::Vector2f& place) const;

  Formation formation_;
  std::vector<std::uint8_t> asked_;      // per agent: called lead() since the last step
  std::vector<Eigen::Vector2f> wanted_;  // per agent: its own preferred velocity
  std::vector<int> place_;               // per agent: index of its position, or kNone
  std::vector<std::uint32_t> members_;   // ids, ascending
  std::vector<std::uint32_t> before_;    // members of the last step
  Eigen::Vector2f heading_ = Eigen::Vector2f::UnitX();
  Eigen::Vector2f velocity_ = Eigen::Vector2f::Zero();
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();  // center of the formation in the world
};

}  // namespace throng::crowd
