#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "places/imports/gazebo/sdf_children.h"
#include "places/imports/gazebo/sdf_reader.h"
#include "places/imports/gazebo/world_population.h"
#include "places/imports/gazebo/world_roads.h"
#include "places/imports/sdf/sdf_root.h"

namespace throng::imports {

using Eigen::Isometry3d;
using Eigen::Vector2d;

namespace {

/// The file from which an element includes models; "" if it includes none.
std::string find_source(const sdf::ElementPtr& element) {
  if (!is_given_text(element->FilePath())) return element->FilePath();
  std::string source;
  for (const char* kind : {"model", "link", "visual", "collision"}) {
    for_each_child(element, kind, [&](const sdf::ElementPtr& child) {
      if (source.empty()) source = find_source(child);
    });
  }
  return source;
}

}  // namespace

void SdfReader::note_state(const sdf::World& world) {
  const sdf::ElementPtr element = find_child(world.Element(), "state");
  for (const std::string& name : state_.inserted) {
    skip(element, name + " <insertions>", "only the <state> has it: save the world with it");
  }
  for (const std::string& name : state_.unread) {
    skip(element, name,
         "is no pose within 5 km of the origin, or no scale: the world's own counts");
  }
  for (const auto& [name, state] : state_.world.models) {
    if (world.ModelNameExists(name)) continue;
    skip(element, "model " + name + " <state>", "the world has no model of this name");
  }
  for (const auto& [name, state] : state_.lights) {
    if (world.LightNameExists(name)) continue;
    skip(element, "light " + name + " <state>", "the world has no light of this name");
  }
}

void SdfReader::add_roads(const sdf::ElementPtr& world) {
  for_each_child(world, "road", [&](const sdf::ElementPtr& road) {
    const std::size_t before = flat_.size();
    if (const auto why = add_road(road, flat_)) {
      return skip(road, fmt::format("road {}", road->Get<std::string>("name")), *why);
    }
    for (std::size_t i = before; i < flat_.size(); ++i) reach(flat_[i].corners);
  });
}

void SdfReader::add_populations(const sdf::ElementPtr& world) {
  for_each_child(world, "population", [&](const sdf::ElementPtr& population) {
    const std::string name = fmt::format("population {}", population->Get<std::string>("name"));
    copied_ = population;
    add_copies(population, name);
    copied_.reset();
    copied_from_.clear();
  });
}

void SdfReader::add_copies(const sdf::ElementPtr& population, const std::string& name) {
  const sdf::ElementPtr model = find_child(population, "model");
  sdf::Root root;
  if (!model || !load_model(model, root)) return skip(population, name, "has no model to copy");
  const sdf::ElementPtr distribution = find_child(population, "distribution");
  const int line = distribution ? distribution->LineNumber().value_or(0) : 0;
  const ModelCopies copies = place_copies(population, text_->value_at(line));
  if (!copies.unread.empty()) skip(population, name, copies.unread);
  copied_from_ = find_source(model);
  for (std::size_t i = 0; i < copies.poses.size(); ++i) {
    EntityState placed;
    placed.pose = copies.poses[i];
    const std::size_t said = place_.skipped.size();
    add_model(*root.Model(), Isometry3d::Identity(), fmt::format("{}_{}", name, i), &placed);
    if (i > 0) place_.skipped.resize(said);  // each copy lacks the same
  }
}

// An actor's script moves it; people of a scenario walk to exits.
void SdfReader::add_actors(const sdf::ElementPtr& world) {
  for_each_child(world, "actor", [&](const sdf::ElementPtr& actor) {
    const std::string name = fmt::format("actor {}", actor->Get<std::string>("name"));
    const auto trajectory = find_child(find_child(actor, "script"), "trajectory");
    const auto waypoint = find_child(trajectory, "waypoint");
    const auto place = waypoint ? waypoint : actor;
    const auto pose = place->HasElement("pose") ? place->Get<ignition::math::Pose3d>("pose")
                                                : ignition::math::Pose3d();
    const Vector2d at(pose.Pos().X(), pose.Pos().Y());
    constexpr double kMaxCoordinateM = 5'000;
    if (!at.allFinite() || at.cwiseAbs().maxCoeff() > kMaxCoordinateM) {
      return skip(actor, name, "is more than 5 km away from the origin");
    }
    place_.people.push_back(at);
    constexpr double kAroundM = 4;  // people begin 2 m and more from the edge
    const Vector2d around = Vector2d::Constant(kAroundM);
    reach({at - around, at + around});
    skip(
        actor, name,
        fmt::format("a person begins at [{:.1f}, {:.1f}] and walks to an exit; its script and skin "
                    "are left out",
                    at.x(), at.y()));
  });
}

}  // namespace throng::imports
