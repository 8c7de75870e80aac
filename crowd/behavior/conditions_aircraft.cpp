#include "crowd/elements/shape_attributes.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

constexpr int kAnyClass = -1;

/// Nobody else is in a box: free seats and aisles.
class Clear : public Condition {
 public:
  Clear(const Box& box, bool relative, int agent_class)
      : box_(box), relative_(relative), agent_class_(agent_class) {}

  bool holds(const Crowd& crowd, std::size_t agent) const override {
    const Agents& agents = crowd.agents;
    const Eigen::Vector2f origin =
        relative_ ? agents.position[agent] : Eigen::Vector2f(Eigen::Vector2f::Zero());
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (i == agent || agents.present[i] == 0) continue;
      if (agent_class_ != kAnyClass && agents.agent_class[i] != agent_class_) continue;
      if (box_.contains(agents.position[i] - origin)) return false;
    }
    return true;
  }

 private:
  Box box_;
  bool relative_;
  int agent_class_;
};

std::unique_ptr<Condition> make_clear(const Element& element, const Attributes& attributes,
                                      BehaviorContext&) {
  element.require_no_children();
  return std::make_unique<Clear>(read_box(element, attributes), attributes.boolean("relative"),
                                 static_cast<int>(attributes.integer("agent_class")));
}

}  // namespace

std::vector<ConditionRegistry::Entry> aircraft_conditions() {
  AttributeTable table = box_attributes();
  table.push_back(boolean("relative", "1: the box goes with the agent; 0: it stands"));
  table.push_back(
      optional(integer("agent_class", "of those who count; -1: all", kAnyClass, kMaxId), "-1"));
  return {{"clear_AABB", "nobody else is in a box along the axes", std::move(table), make_clear}};
}

}  // namespace throng::crowd
