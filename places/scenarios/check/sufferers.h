// Text of findings about people: the first person concerned, and the number of others.
#pragma once

#include <fmt/core.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "places/scenarios/check/survey.h"

namespace throng::scenarios {

/// A point as "[x, y]" in meters.
inline std::string point_text(const Eigen::Vector2d& point) {
  return fmt::format("[{:.4g}, {:.4g}]", point.x(), point.y());
}

/// Collects the people with the same problem.
class Sufferers {
 public:
  explicit Sufferers(const LoadedCrowd& loaded) : loaded_(loaded) {}

  void add(std::size_t agent, const Eigen::Vector2d& at, const std::string& what) {
    if (count_++ > 0) return;
    where_ = loaded_.part_of(agent);
    const std::string who =
        loaded_.parts.empty() ? fmt::format("agent {}", agent) : std::string("a person");
    first_ = fmt::format("{} at {} {}", who, point_text(at), what);
  }
  bool any() const { return count_ > 0; }
  /// The JSON pointer to what says where the first one starts.
  const std::string& where() const { return where_; }
  std::string text() const {
    return count_ > 1 ? fmt::format("{}, and {} more", first_, count_ - 1) : first_;
  }

 private:
  const LoadedCrowd& loaded_;
  std::size_t count_ = 0;
  std::string where_;
  std::string first_;
};

/// Whether an agent is a person who is present at the start or arrives later.
inline bool is_to_arrive_or_there(const LoadedCrowd& loaded, std::size_t agent) {
  return loaded.is_person[agent] != 0 && loaded.crowd.agents.position[agent].allFinite();
}

}  // namespace throng::scenarios
