#include "places/imports/gazebo/saved_state.h"

#include <fmt/core.h>

#include <sdf/sdf.hh>

#include "places/imports/gazebo/sdf_children.h"

namespace throng::imports {

namespace {

const EntityState* find_in(const std::map<std::string, EntityState>& states,
                           const std::string& name) {
  const auto found = states.find(name);
  return found == states.end() ? nullptr : &found->second;
}

class StateReader {
 public:
  explicit StateReader(SavedState& saved) : saved_(saved) {}

  EntityState entity(const sdf::ElementPtr& element, const std::string& path) {
    EntityState state;
    read_pose(element, path, state);
    read_scale(element, path, state);
    for_each_child(element, "link", [&](const sdf::ElementPtr& link) {
      const auto name = link->Get<std::string>("name");
      state.links[name] = entity(link, path + "/" + name);
    });
    for_each_child(element, "model", [&](const sdf::ElementPtr& model) {
      const auto name = model->Get<std::string>("name");
      state.models[name] = entity(model, path + "/" + name);
    });
    return state;
  }

 private:
  void read_pose(const sdf::ElementPtr& element, const std::string& path, EntityState& state) {
    if (!element->HasElement("pose")) return;
    const auto pose = element->Get<ignition::math::Pose3d>("pose");
    const Eigen::Vector3d at(pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
    const Eigen::Quaterniond turn(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z());
    constexpr double kMaxCoordinateM = 5'000;
    const bool is_near = at.allFinite() && at.cwiseAbs().maxCoeff() <= kMaxCoordinateM;
    if (!is_near || !turn.coeffs().allFinite() || turn.norm() < 0.5) {
      saved_.unread.push_back(path + "/<pose>");
      return;
    }
    state.pose = Eigen::Isometry3d::Identity();
    state.pose->linear() = turn.normalized().toRotationMatrix();
    state.pose->translation() = at;
  }

  void read_scale(const sdf::ElementPtr& element, const std::string& path, EntityState& state) {
    if (!element->HasElement("scale")) return;
    const auto scale = element->Get<ignition::math::Vector3d>("scale");
    const Eigen::Vector3d factors(scale.X(), scale.Y(), scale.Z());
    if (factors.allFinite() && factors.minCoeff() > 0) {
      state.scale = factors;
    } else {
      saved_.unread.push_back(path + "/<scale>");
    }
  }

  SavedState& saved_;
};

}  // namespace

const EntityState* EntityState::model(const std::string& name) const {
  return find_in(models, name);
}

const EntityState* EntityState::link(const std::string& name) const { return find_in(links, name); }

SavedState read_saved_state(const sdf::World& world) {
  SavedState saved;
  if (!world.Element() || !world.Element()->HasElement("state")) return saved;
  StateReader reader(saved);
  for_each_child(world.Element(), "state", [&](const sdf::ElementPtr& state) {
    for_each_child(state, "model", [&](const sdf::ElementPtr& model) {
      const auto name = model->Get<std::string>("name");
      saved.world.models[name] = reader.entity(model, name);
    });
    for_each_child(state, "light", [&](const sdf::ElementPtr& light) {
      const auto name = light->Get<std::string>("name");
      saved.lights[name] = reader.entity(light, name);
    });
    for_each_child(state, "deletions", [&](const sdf::ElementPtr& deletions) {
      for_each_child(deletions, "name", [&](const sdf::ElementPtr& name) {
        saved.deleted.push_back(name->Get<std::string>());
      });
    });
    for_each_child(state, "insertions", [&](const sdf::ElementPtr& insertions) {
      for (const char* kind : {"model", "light"}) {
        for_each_child(insertions, kind, [&](const sdf::ElementPtr& one) {
          saved.inserted.push_back(fmt::format("{} {}", kind, one->Get<std::string>("name")));
        });
      }
    });
  });
  return saved;
}

}  // namespace throng::imports
