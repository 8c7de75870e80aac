// Functions that create the most frequent elements of descriptions. Other elements are created with
// Node or typed(); docs/reference/crowd_vocabulary.md lists all elements, their types and
// attributes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "crowd/description/node.h"

namespace throng::crowd::describe {

using Points = std::vector<Eigen::Vector2d>;  ///< m

/// Value of `decimals` for the shortest text that is read as the same number.
inline constexpr int kAllDigits = -1;

/// Formats a number with at most `digits` significant digits, without trailing zeros.
std::string significant_text(double value, int digits);

/// Creates `<name type="type" ...>`.
Node typed(std::string name, std::string_view type, std::vector<Attribute> attributes = {},
           std::vector<Node> children = {});

/// A distribution from which values are sampled (see crowd/elements/distribution.h).
class Sampled {
 public:
  static Sampled constant(double value);
  static Sampled uniform(double min, double max);
  static Sampled normal(double mean, double stddev);
  static Sampled lognormal(double log_mean, double log_stddev);

  /// Returns a normal or lognormal distribution truncated to [at_least, at_most].
  Sampled limited(double at_least, double at_most) const;

  /// Returns the XML attributes; with the prefix "displace_": displace_dist, displace_min, ...
  std::vector<Attribute> attributes(std::string_view prefix = "") const;

 private:
  explicit Sampled(std::vector<Attribute> attributes) : attributes_(std::move(attributes)) {}
  std::vector<Attribute> attributes_;
};

// Elements of a scene.

/// Creates a property of a profile, sampled per agent: `property("pref_speed", Sampled::...)`.
Node property(std::string_view name, const Sampled& value);
/// Creates the element with a model's parameters or constants: `model("ORCA", {{"tau", 3}})`.
Node model(std::string tag, std::vector<Attribute> attributes);
/// Creates a generator with one agent at each point (m).
Node agents_at(const Points& points, int decimals = kAllDigits);
/// Creates `<Vertex>` elements, e.g. of a generator's area.
std::vector<Node> vertices(const Points& points, int decimals = kAllDigits);
/// Creates an obstacle from a closed outline: solid if counter-clockwise, an outer wall if
/// clockwise.
Node obstacle(const Points& outline, int decimals = kAllDigits);

// Elements of a behavior.

Node circle_goal(int id, const Eigen::Vector2d& center, double radius_m, int decimals = kAllDigits);
Node box_goal(int id, const Eigen::Vector2d& min, const Eigen::Vector2d& max);
/// Creates a selector that chooses a goal of a set for each agent of a state: "nearest", "random",
/// "weighted", "exit_choice", ...
Node select_goal(std::string_view type, int goal_set, std::vector<Attribute> more = {});
/// Creates a selector that gives all agents the same goal.
Node select_goal(int goal_set, int goal);
/// Creates a selector with which agents stay at their positions.
Node select_own_place();
/// Creates the component that computes the preferred velocity: "auto" (around obstacles), "goal"
/// (straight to the goal), "zero", ...
Node velocity(std::string_view type, std::vector<Attribute> attributes = {});
Node action(std::string_view type, std::vector<Attribute> attributes = {});
/// Creates the condition of a transition: "goal_reached", "timer", "and", "or", "not", ...
Node condition(std::string_view type, std::vector<Attribute> attributes = {},
               std::vector<Node> parts = {});
Node goal_reached(double distance_m = 0);
/// Creates a condition that holds after a time in the state (s), sampled per agent or once for all.
Node timer(const Sampled& time_s, bool per_agent = true);

}  // namespace throng::crowd::describe
