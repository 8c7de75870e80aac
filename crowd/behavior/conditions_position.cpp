#include "crowd/elements/shape_attributes.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

/// Whether the agent's center is in a region, or outside it.
template <typename Shape>
class Where : public Condition {
 public:
  Where(const Shape& shape, bool inside) : shape_(shape), inside_(inside) {}
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return shape_.contains(crowd.agents.position[agent]) == inside_;
  }

 private:
  Shape shape_;
  bool inside_;
};

AttributeTable with_inside(AttributeTable table) {
  table.push_back(boolean("inside", "1: true inside; 0: true outside"));
  return table;
}

template <typename Shape>
std::unique_ptr<Condition> where(const Shape& shape, const Attributes& attributes) {
  return std::make_unique<Where<Shape>>(shape, attributes.boolean("inside"));
}

std::unique_ptr<Condition> make_circle(const Element& element, const Attributes& attributes,
                                       BehaviorContext&) {
  element.require_no_children();
  return where(read_circle(attributes, "center_x", "center_y"), attributes);
}

std::unique_ptr<Condition> make_box(const Element& element, const Attributes& attributes,
                                    BehaviorContext&) {
  element.require_no_children();
  return where(read_box(element, attributes), attributes);
}

std::unique_ptr<Condition> make_turned_box(const Element& element, const Attributes& attributes,
                                           BehaviorContext&) {
  element.require_no_children();
  return where(read_turned_box(attributes, "pivot_x", "pivot_y"), attributes);
}

}  // namespace

std::vector<ConditionRegistry::Entry> place_conditions() {
  return {
      {"circle", "in a disc", with_inside(circle_attributes("center_x", "center_y")), make_circle},
      {"AABB", "in a box along the axes", with_inside(box_attributes()), make_box},
      {"OBB", "in a turned box", with_inside(turned_box_attributes("pivot_x", "pivot_y")),
       make_turned_box},
  };
}

}  // namespace throng::crowd
