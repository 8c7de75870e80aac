// The elements that most descriptions need, as functions; any other is a Node written out, or
// typed(). docs/reference/crowd_vocabulary.md lists every element, its types and attributes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "crowd/description/node.h"

namespace throng::crowd::describe {

using Points = std::vector<Eigen::Vector2d>;  ///< m

/// Coordinates with all digits, as many as it takes to read the same number again.
inline constexpr int kAllDigits = -1;

/// A number rounded to so many significant digits, without trailing zeros.
std::string significant_text(double value, int digits);

/// `<name type="type" ...>`.
Node typed(std::string name, std::string_view type, std::vector<Attribute> attributes = {},
           std::vector<Node> children = {});

/// A distribution that values are sampled from (crowd/elements/distribution.h).
class Sampled {
 public:
  static Sampled constant(double value);
  static Sampled uniform(double min, double max);
  static Sampled normal(double mean, double stddev);
  static Sampled lognormal(double log_mean, double log_stddev);

  /// Limits, which samples beyond are moved to.
  Sampled limited(double at_least, double at_most) const;

  /// As attributes; with the prefix "displace_": displace_dist, displace_min, ...
  std::vector<Attribute> attributes(std::string_view prefix = "") const;

 private:
  explicit Sampled(std::vector<Attribute> attributes) : attributes_(std::move(attributes)) {}
  std::vector<Attribute> attributes_;
};

// Elements of a scene.

/// A property of a profile, sampled for each agent: `property("pref_speed", Sampled::...)`.
Node property(std::string_view name, const Sampled& value);
/// The model's parameters or constants: `model("ORCA", {{"tau", 3}})`.
Node model(std::string tag, std::vector<Attribute> attributes);
/// A generator of agents at these points, m.
Node agents_at(const Points& points, int decimals = kAllDigits);
/// `<Vertex>` elements, e.g. of a generator's area.
std::vector<Node> vertices(const Points& points, int decimals = kAllDigits);
/// A closed outline: solid when counter-clockwise, an outer wall when clockwise.
Node obstacle(const Points& outline, int decimals = kAllDigits);

// Elements of a behavior.

Node circle_goal(int id, const Eigen::Vector2d& center, double radius_m, int decimals = kAllDigits);
Node box_goal(int id, const Eigen::Vector2d& min, const Eigen::Vector2d& max);
/// How a state's agents choose a goal of a set: "nearest", "random", "weighted", "exit_choice", ...
Node select_goal(std::string_view type, int goal_set, std::vector<Attribute> more = {});
/// One goal for all.
Node select_goal(int goal_set, int goal);
/// Everybody stays where they are.
Node select_own_place();
/// How a state's agents get to their goal: "auto" (around obstacles), "goal" (straight), "zero",
/// ...
Node velocity(std::string_view type, std::vector<Attribute> attributes = {});
Node action(std::string_view type, std::vector<Attribute> attributes = {});
/// When a transition is taken: "goal_reached", "timer", "and", "or", "not", ...
Node condition(std::string_view type, std::vector<Attribute> attributes = {},
               std::vector<Node> parts = {});
Node goal_reached(double distance_m = 0);
/// After a time in the state, in s; sampled for each agent, or once for all.
Node timer(const Sampled& time_s, bool per_agent = true);

}  // namespace throng::crowd::describe
