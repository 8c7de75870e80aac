#include <limits>

#include "crowd/navigation/nav_mesh_file.h"
#include "crowd/navigation/navigation.h"
#include "crowd/navigation/path_finder.h"
#include "crowd/navigation/steering.h"

namespace throng::crowd {

namespace {

/// By the length of the way across a mesh, among the goals with room that can be reached.
class ByWay : public GoalSelector {
 public:
  ByWay(std::shared_ptr<const NavMeshFile> file, int set, bool nearest)
      : file_(std::move(file)), finder_(file_->mesh), set_(set), nearest_(nearest) {}

  Choice select(const Crowd& crowd, std::size_t agent) override {
    const Eigen::Vector2f& p = crowd.agents.position[agent];
    const NavMesh::Location from = file_->mesh.nearest(p);
    Choice best{-1, p};
    float best_key = std::numeric_limits<float>::infinity();
    for (const int goal : crowd.goals.set(set_).goals) {
      if (!crowd.goals[goal].has_room()) continue;
      const NavMesh::Location to = file_->mesh.nearest(crowd.goals[goal].shape->center());
      if (!finder_.find(from, to, crowd.agents[Property::radius][agent])) continue;
      const float key = nearest_ ? finder_.length_m() : -finder_.length_m();
      if (key >= best_key) continue;
      best.goal = goal;
      best_key = key;
    }
    return best;
  }

 private:
  std::shared_ptr<const NavMeshFile> file_;
  PathFinder finder_;
  int set_;
  bool nearest_;
};

template <bool kMinDistance>
std::unique_ptr<GoalSelector> make_by_way(const Element& element, const Attributes& attributes,
                                          BehaviorContext& context) {
  const int set = context.goals.require_set(element, attributes, "goal_set");
  return std::make_unique<ByWay>(
      shared_nav_mesh(element.text_file(attributes.text("file_name")), *context.crowd.parts), set,
      kMinDistance);
}

}  // namespace

std::vector<GoalSelectorRegistry::Entry> navigation_goal_selectors() {
  const AttributeTable table = {integer("goal_set", "id of a goal set", 0, kMaxId),
                                text("file_name", "of a navigation mesh (.nav)")};
  return {
      {"nearest_nav_mesh", "the nearest of a set, by the path across a mesh", table,
       make_by_way<true>},
      {"farthest_nav_mesh", "the farthest of a set, by the path across a mesh", table,
       make_by_way<false>},
  };
}

}  // namespace throng::crowd
