// Formations: places that people who walk together take, relative to each other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/behavior.h"
#include "crowd/elements/text_file.h"

namespace throng::crowd {

/// The places of a formation, seen along the way that it goes (+x).
class Formation {
 public:
  /// Reads a file of numbers: how many points the border has; x, y and weight of these and of any
  /// inside of it; and last the x and y of the way that it goes. Throws InputError.
  explicit Formation(const TextFile& source);

  /// In m, those of the greatest weight first.
  const std::vector<Eigen::Vector2f>& places() const { return places_; }

 private:
  std::vector<Eigen::Vector2f> places_;
};

/// The members of a formation, their current places in it and their common speed. They take the
/// mean of their preferred velocities; the formation's center is that of its members.
class FormationGroup : public Process {
 public:
  FormationGroup(Formation formation, std::size_t agent_count);

  /// Gathers agents that have asked since the last step, and gives them their places. The places
  /// are taken in the order of their weights, each by the nearest agent without one, and kept until
  /// an agent joins or leaves; agents without a place walk alone.
  void before_decisions(Crowd& crowd, Machine& machine) override;

  /// An agent would go like this; returns how it goes in the formation. Called for different agents
  /// at once.
  PreferredVelocity lead(const Crowd& crowd, std::size_t agent, const PreferredVelocity& alone);

 private:
  static constexpr int kNone = -1;

  bool gather(const Crowd& crowd);
  void take_places(const Crowd& crowd, const Eigen::Vector2f& middle);
  Eigen::Vector2f middle_of_members(const Crowd& crowd) const;
  Eigen::Vector2f turned(const Eigen::Vector2f& place) const;

  Formation formation_;
  std::vector<std::uint8_t> asked_;      // per agent, since the last step
  std::vector<Eigen::Vector2f> wanted_;  // per agent, its velocity if alone
  std::vector<int> place_;               // per agent, or kNone
  std::vector<std::uint32_t> members_;   // ids, ascending
  std::vector<std::uint32_t> before_;    // those of the last step
  Eigen::Vector2f heading_ = Eigen::Vector2f::UnitX();
  Eigen::Vector2f velocity_ = Eigen::Vector2f::Zero();
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();  // of the formation, in the world
};

}  // namespace throng::crowd
