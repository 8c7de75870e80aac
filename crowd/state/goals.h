// Goals: regions to which agents walk, in numbered sets.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "crowd/agents/types.h"
#include "crowd/elements/registry.h"
#include "crowd/state/goal_path.h"

namespace throng::crowd {

/// A region of the plane. A goal's shape may move.
class GoalShape {
 public:
  virtual ~GoalShape() = default;

  /// Center, to which selectors measure distances.
  virtual Eigen::Vector2f center() const = 0;
  virtual void move_to(const Eigen::Vector2f& center) = 0;
  /// Returns the point nearest to p of the region shrunk by `margin` on all sides, at most to its
  /// center line or center; p itself if it is inside.
  virtual Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const = 0;

  /// Distance of p from the region (m); 0 inside.
  float distance(const Eigen::Vector2f& p) const { return (nearest_point(p, 0) - p).norm(); }
  /// Distance in Menge's definition: to the circumference of a circle also from inside, and beside
  /// a box to the point whose coordinate along the side is 0.
  virtual float menge_distance(const Eigen::Vector2f& p) const { return distance(p); }
};

/// A goal of a goal set.
struct Goal {
  GoalId id;
  std::unique_ptr<GoalShape> shape;
  std::uint32_t capacity = std::numeric_limits<std::uint32_t>::max();
  float weight = 1;
  std::uint32_t assigned = 0;  ///< number of agents with this goal, or that keep it persistently
  std::unique_ptr<GoalPath> path = {};                ///< path of a moving goal, else null
  Eigen::Vector2f on_path = Eigen::Vector2f::Zero();  ///< center relative to the path

  bool has_room() const { return assigned < capacity; }
  /// Distance (m), as conditions measure it.
  float distance(const Eigen::Vector2f& p, Compat compat) const {
    return compat == Compat::none ? shape->distance(p) : shape->menge_distance(p);
  }
};

struct GoalSet {
  int id = 0;
  std::vector<int> goals;  ///< indices into Goals
};

/// All goals of a behavior file. Other objects refer to goals and sets by index.
class Goals {
 public:
  /// Reads a <GoalSet> and returns its index. A set with the id of an earlier one extends it, with
  /// a warning. Throws InputError for a duplicate goal id in a set.
  int load_set(const Element& element);

  /// Moves goals along their paths.
  void advance_paths(double dt_s);
  bool any_path() const;

  Goal& operator[](int index) { return goals_[static_cast<std::size_t>(index)]; }
  const Goal& operator[](int index) const { return goals_[static_cast<std::size_t>(index)]; }
  int count() const { return static_cast<int>(goals_.size()); }
  const GoalSet& set(int index) const { return sets_[static_cast<std::size_t>(index)]; }

  /// Return the index of a set or goal with these ids, or -1.
  int find_set(int set_id) const;
  int find_goal(int set_id, int goal_id) const;

  /// Returns the index of the set that an attribute names. Throws InputError if it is empty or does
  /// not exist, with a list of sets.
  int require_set(const Element& element, const Attributes& attributes,
                  std::string_view attribute) const;
  /// Whether require_set() has returned it.
  bool is_used(int set) const { return used_[static_cast<std::size_t>(set)] != 0; }

 private:
  int add_goal(const Element& element, int set);

  std::vector<Goal> goals_;
  std::vector<GoalSet> sets_;
  mutable std::vector<std::uint8_t> used_;  // per set; for warnings about unused sets
};

/// Inputs of the factories of shapes, set from other attributes of the element.
struct GoalContext {
  std::unique_ptr<GoalPath> path = {};
};
using GoalRegistry = Registry<GoalShape, GoalContext>;
/// Types: point, circle, AABB, OBB, path.
const GoalRegistry& goal_registry();

/// Returns `shape` and the optional attributes of all shapes, for elements that choose a shape.
AttributeTable shape_choice_attributes();
/// Creates the chosen shape. Throws InputError if the element lacks one of its attributes.
std::unique_ptr<GoalShape> read_shape_choice(const Element& element, const Attributes& attributes);

}  // namespace throng::crowd
