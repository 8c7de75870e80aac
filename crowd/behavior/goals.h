// Goals: regions that agents walk to, in numbered sets.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "crowd/behavior/goal_path.h"
#include "crowd/elements/registry.h"
#include "crowd/types.h"

namespace throng::crowd {

/// A region of the plane.
class GoalShape {
 public:
  virtual ~GoalShape() = default;

  /// The middle; selectors measure to it.
  virtual Eigen::Vector2f center() const = 0;
  virtual void move_to(const Eigen::Vector2f& center) = 0;
  /// The point nearest to p of the region made smaller by `margin` on all sides (down to its
  /// middle line or point where it is too small for that); p itself when it is inside.
  virtual Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const = 0;

  /// 0 inside, m.
  float distance(const Eigen::Vector2f& p) const { return (nearest_point(p, 0) - p).norm(); }
  /// Menge's distance: it measures to a circle's line also from within, and
  /// beside a box to a point whose coordinate along the side is 0.
  virtual float menge_distance(const Eigen::Vector2f& p) const { return distance(p); }
};

struct Goal {
  GoalId id;
  std::unique_ptr<GoalShape> shape;
  std::uint32_t capacity = std::numeric_limits<std::uint32_t>::max();
  float weight = 1;
  std::uint32_t assigned = 0;           ///< agents that have it as their goal, or keep it as theirs
  std::unique_ptr<GoalPath> path = {};  ///< what it moves along, if it does
  Eigen::Vector2f on_path = Eigen::Vector2f::Zero();  ///< its center, seen from the path

  bool has_room() const { return assigned < capacity; }
  /// In m, as conditions measure it.
  float distance(const Eigen::Vector2f& p, Compat compat) const {
    return compat == Compat::none ? shape->distance(p) : shape->menge_distance(p);
  }
};

struct GoalSet {
  int id = 0;
  std::vector<int> goals;  ///< indices
};

/// All goals of a behavior file; others refer to them and to the sets by index.
class Goals {
 public:
  /// Reads a <GoalSet> and returns its index. One with the id of an earlier set adds to that, with
  /// a warning. Throws InputError for a goal id that its set has already.
  int load_set(const Element& element);

  /// Moves those that have a path along it.
  void advance_paths(double dt_s);
  bool any_path() const;

  Goal& operator[](int index) { return goals_[static_cast<std::size_t>(index)]; }
  const Goal& operator[](int index) const { return goals_[static_cast<std::size_t>(index)]; }
  int count() const { return static_cast<int>(goals_.size()); }
  const GoalSet& set(int index) const { return sets_[static_cast<std::size_t>(index)]; }

  /// -1 when there is none.
  int find_set(int set_id) const;
  int find_goal(int set_id, int goal_id) const;

  /// The set that an element's attribute names. Throws InputError for an empty one, or when there
  /// is none, listing those that there are.
  int require_set(const Element& element, const Attributes& attributes,
                  std::string_view attribute) const;
  /// Whether anybody has required it.
  bool is_used(int set) const { return used_[static_cast<std::size_t>(set)] != 0; }

 private:
  int add_goal(const Element& element, int set);

  std::vector<Goal> goals_;
  std::vector<GoalSet> sets_;
  mutable std::vector<std::uint8_t> used_;  // per set; only for telling which are not
};

/// Attributes of a goal's element beside its shape.
struct GoalContext {
  std::unique_ptr<GoalPath> path = {};
};
using GoalRegistry = Registry<GoalShape, GoalContext>;
/// point, circle, AABB, OBB, path.
const GoalRegistry& goal_registry();

/// For elements that choose a shape: `shape` and the attributes of every one, as far as they are
/// given.
AttributeTable shape_choice_attributes();
/// Throws InputError when the shape lacks an attribute.
std::unique_ptr<GoalShape> read_shape_choice(const Element& element, const Attributes& attributes);

}  // namespace throng::crowd
