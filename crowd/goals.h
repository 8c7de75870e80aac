// Goals: regions that agents walk to, in numbered sets.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "crowd/registry.h"
#include "crowd/simulation.h"

namespace throng::crowd {

/// A region of the plane.
class GoalShape {
 public:
  virtual ~GoalShape() = default;

  /// The middle; selectors measure to it.
  virtual Eigen::Vector2f centre() const = 0;
  virtual void move_to(const Eigen::Vector2f& centre) = 0;
  /// The point nearest to p of the region made smaller by `margin` on all sides (down to its
  /// middle line or point where it is too small for that); p itself when it is inside.
  virtual Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const = 0;

  /// 0 inside, m.
  float distance(const Eigen::Vector2f& p) const { return (nearest_point(p, 0) - p).norm(); }
};

struct Goal {
  GoalId id;
  std::unique_ptr<GoalShape> shape;
  std::uint32_t capacity = std::numeric_limits<std::uint32_t>::max();
  float weight = 1;
  std::uint32_t assigned = 0;  ///< agents that have it as their goal

  bool has_room() const { return assigned < capacity; }
};

struct GoalSet {
  int id = 0;
  std::vector<int> goals;  ///< indices, never empty
};

/// All goals of a behaviour file; others refer to them and to the sets by index.
class Goals {
 public:
  /// Reads a <GoalSet>. Throws InputError for one that is empty, or an id that is already taken.
  void load_set(const Element& element);

  Goal& operator[](int index) { return goals_[static_cast<std::size_t>(index)]; }
  const Goal& operator[](int index) const { return goals_[static_cast<std::size_t>(index)]; }
  const GoalSet& set(int index) const { return sets_[static_cast<std::size_t>(index)]; }

  /// -1 when there is none.
  int find_set(int set_id) const;
  int find_goal(int set_id, int goal_id) const;

  /// The set that an element's attribute names. Throws InputError, listing those that there are.
  int require_set(const Element& element, const Attributes& attributes,
                  std::string_view attribute) const;

 private:
  std::vector<Goal> goals_;
  std::vector<GoalSet> sets_;
};

struct GoalContext {};
using GoalRegistry = Registry<GoalShape, GoalContext>;
/// point, circle, AABB, OBB.
const GoalRegistry& goal_registry();

}  // namespace throng::crowd
