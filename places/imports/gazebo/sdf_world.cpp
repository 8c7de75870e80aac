#include "places/imports/gazebo/sdf_world.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/geometry/rectangle.h"
#include "places/imports/gazebo/sdf_reader.h"
#include "places/imports/gazebo/world_fixtures.h"
#include "places/imports/parts/scenario_name.h"
#include "places/imports/parts/scenario_writer.h"
#include "places/imports/parts/solids.h"
#include "places/imports/sdf/sdf_pose.h"
#include "places/imports/sdf/sdf_root.h"

namespace throng::imports {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kTallM = 2;
constexpr double kOnGroundM = 0.5;
constexpr double kMinBuildingM2 = 0.3;
constexpr double kMaxCoordinateM = 5'000;
constexpr std::size_t kMaxBodies = 20'000;
constexpr std::size_t kMaxTriangles = 2'000'000;

using Words = std::set<std::string>;

// Elements that mean nothing to a scenario, or that are read.
const Words& known_in(const std::string& parent) {
  static const Words kWorld = {"model",
                               "light",
                               "frame",
                               "gravity",
                               "magnetic_field",
                               "include",
                               "spherical_coordinates",
                               "state",
                               "road",
                               "population",
                               "actor"};
  static const Words kModel = {
      "pose",        "static", "link", "model", "frame", "self_collide", "allow_auto_disable",
      "enable_wind", "include"};
  static const Words kLink = {"pose",    "visual",         "collision",         "inertial",
                              "gravity", "kinematic",      "enable_wind",       "self_collide",
                              "light",   "velocity_decay", "must_be_base_link", "sensor"};
  return parent == "world" ? kWorld : parent == "model" ? kModel : kLink;
}

std::vector<fs::path> list_folders(const fs::path& file, const SdfOptions& options) {
  std::vector<fs::path> folders = options.models;
  // The folders of models in repositories of worlds.
  folders.push_back(file.parent_path() / "models");
  folders.push_back(file.parent_path() / ".." / "models");
  folders.insert(folders.begin(), file.parent_path());
  return folders;
}

}  // namespace

SdfReader::SdfReader(const fs::path& file, const SdfOptions& options)
    : file_(file), gates_(options.gates), files_(list_folders(file, options)) {}

void SdfReader::skip(const sdf::ElementPtr& element, const std::string& what,
                     const std::string& why) {
  Skipped skipped{file_.string(), 0, what, why};
  const sdf::ElementPtr& at = copied_ ? copied_ : element;
  if (at) {
    const int line = at->LineNumber().value_or(0);
    const bool own = is_given_text(at->FilePath());
    if (!own) skipped.file = at->FilePath();
    skipped.line = own && line > 0 ? text_->line_of(line) : line;
  }
  place_.skipped.push_back(std::move(skipped));
}

void SdfReader::skip_unknown(const sdf::ElementPtr& parent, const std::string& path) {
  if (!parent) return;
  for (auto child = parent->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string& name = child->GetName();
    if (!child->GetExplicitlySetInFile() || known_in(parent->GetName()).contains(name)) continue;
    skip(child, fmt::format("{} <{}>", path, name), "has no meaning in a scenario");
  }
}

std::optional<Isometry3d> SdfReader::resolve(const sdf::SemanticPose& pose,
                                             const Isometry3d& parent,
                                             const sdf::ElementPtr& element,
                                             const std::string& path) {
  const std::optional<Isometry3d> local = resolved_pose(pose);
  if (!local) {
    skip(element, path,
         fmt::format("its pose is no pose, or relative to \"{}\", which is unknown",
                     pose.RelativeTo()));
    return std::nullopt;
  }
  const Isometry3d whole = parent * *local;
  if (!(whole.translation().cwiseAbs().maxCoeff() <= kMaxCoordinateM)) {
    skip(element, path, "is more than 5 km away from the origin");
    return std::nullopt;
  }
  return whole;
}

template <typename Owner>
std::optional<Body> SdfReader::body(const Owner& owner, const Isometry3d& link,
                                    const std::string& path) {
  const std::string name = path + "/" + owner.Name();
  const auto pose = resolve(owner.SemanticPose(), link, owner.Element(), name);
  if (!pose) return std::nullopt;
  if (++bodies_ > kMaxBodies) {
    throw InputError(
        {file_.string(), "", fmt::format("more than {} bodies", kMaxBodies), "a smaller world"});
  }
  std::optional<Body> found;
  try {
    std::string from = owner.Element() ? owner.Element()->FilePath() : "";
    if (is_given_text(from)) from = copied_from_.empty() ? file_.string() : copied_from_;
    found = make_body(*owner.Geom(), *pose, from, files_, scale_);
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    skip(owner.Element(), name, fmt::format("{}, not {}", problem.found, problem.expected));
    return std::nullopt;
  }
  for (const Solid& solid : found->solids) triangles_ += solid.triangles.size();
  if (triangles_ > kMaxTriangles) {
    throw InputError({file_.string(), "", fmt::format("more than {} triangles", kMaxTriangles),
                      "a smaller world"});
  }
  return found;
}

void SdfReader::reach(const Corners& corners) {
  for (const Vector2d& corner : corners) {
    low_ = low_.cwiseMin(corner);
    high_ = high_.cwiseMax(corner);
  }
}

// Buildings that are there already are cut out, so that no two buildings overlap.
void SdfReader::add_building(const Body& body) {
  std::vector<Area> others;
  const geometry::Rectangle bounds = geometry::bounding_box(*body.footprint);
  for (std::size_t i = 0; i < place_.buildings.size(); ++i) {
    if (bounds.meets(building_bounds_[i])) others.push_back({place_.buildings[i].footprint, {}});
  }
  for (const Area& rest : without({*body.footprint, {}}, others)) {
    for (Corners& part : simple_parts(rest, kMinBuildingM2)) {
      building_bounds_.push_back(geometry::bounding_box(part));
      place_.buildings.push_back({fmt::format("b{}", place_.buildings.size() + 1), std::move(part),
                                  std::min(body.to_z, 900.0), world::Facade::by_id});
    }
  }
}

void SdfReader::add_seen(Body body, const Vector3d* rgb, Object& object) {
  if (rgb != nullptr) {
    for (Solid& solid : body.solids) solid.rgb = *rgb;
  }
  if (body.footprint && body.to_z < kStepM && body.to_z > -kOnGroundM) {
    const Vector3d gray(0.5, 0.5, 0.5);
    flat_.push_back({body.to_z, *body.footprint, ground_material_like(rgb ? *rgb : gray)});
    return;
  }
  if (body.footprint && body.from_z < kOnGroundM && body.to_z >= kTallM &&
      size_m2({*body.footprint, {}}) >= kMinBuildingM2) {
    reach(*body.footprint);
    add_building(body);
    return;
  }
  for (Solid& solid : body.solids) {
    double top = -1;
    for (const Triangle& triangle : solid.triangles) {
      for (const Vector3d& corner : triangle) top = std::max(top, corner.z());
    }
    if (top <= 0.01) continue;  // below the ground
    for (const Triangle& triangle : solid.triangles) {
      for (const Vector3d& corner : triangle) reach({corner.head<2>()});
    }
    object.solids.push_back(std::move(solid));
  }
}

void SdfReader::add_in_the_way(const Body& body) {
  if (body.footprint) {
    if (is_overhead(body.from_z) || is_step(body.to_z)) return;
    reach(*body.footprint);
    place_.obstacles.push_back(*body.footprint);
    return;
  }
  Triangles triangles;
  for (const Solid& solid : body.solids) {
    triangles.insert(triangles.end(), solid.triangles.begin(), solid.triangles.end());
  }
  for (Corners& corners : project_shadow(triangles)) {
    reach(corners);
    place_.obstacles.push_back(std::move(corners));
  }
}

void SdfReader::add_link(const sdf::Link& link, const Isometry3d& model, const std::string& path,
                         Object& object, const EntityState* state) {
  const std::string name = path + "/" + link.Name();
  const bool is_placed = state != nullptr && state->pose.has_value();
  const auto pose =
      is_placed ? state->pose : resolve(link.SemanticPose(), model, link.Element(), name);
  if (!pose) return;
  skip_unknown(link.Element(), name);
  bool drawn = link.VisualCount() == 0;  // or meant to be invisible
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& visual = *link.VisualByIndex(i);
    auto seen = body(visual, *pose, name);
    if (!seen) continue;
    drawn = true;
    if (link.CollisionCount() == 0) add_in_the_way(*seen);
    const auto rgb = material_color(visual.Material());
    add_seen(std::move(*seen), rgb ? &*rgb : nullptr, object);
  }
  bool by_collisions = false;
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    auto felt = body(*link.CollisionByIndex(i), *pose, name);
    if (!felt) continue;
    add_in_the_way(*felt);
    if (drawn) continue;
    by_collisions = true;
    add_seen(std::move(*felt), nullptr, object);
  }
  if (by_collisions) skip(link.Element(), name, "drawn by its collisions, for want of visuals");
  for (std::uint64_t i = 0; i < link.LightCount(); ++i) {
    add_light(*link.LightByIndex(i), *pose, name);
  }
  for (std::uint64_t i = 0; i < link.SensorCount(); ++i) {
    add_sensor(*link.SensorByIndex(i), *pose, name);
  }
}

void SdfReader::add_model(const sdf::Model& model, const Isometry3d& parent,
                          const std::string& path, const EntityState* state) {
  const std::string name = path.empty() ? model.Name() : path + "/" + model.Name();
  const bool is_placed = state != nullptr && state->pose.has_value();
  const auto pose =
      is_placed ? state->pose : resolve(model.SemanticPose(), parent, model.Element(), name);
  if (!pose) return;
  if (is_robot(model)) {
    add_robot(model, *pose, place_);
    return reach({pose->translation().head<2>()});
  }
  skip_unknown(model.Element(), name);
  if (model.LinkCount() + model.ModelCount() == 0) skip(model.Element(), name, "has no links");
  const Vector3d scale_around = scale_;
  if (state != nullptr) scale_ = scale_.cwiseProduct(state->scale);
  Object object{name, {}};
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    add_link(link, *pose, name, object, state ? state->link(link.Name()) : nullptr);
  }
  if (!object.solids.empty()) place_.objects.push_back(std::move(object));
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& nested = *model.ModelByIndex(i);
    add_model(nested, *pose, name, state ? state->model(nested.Name()) : nullptr);
  }
  scale_ = scale_around;
}

void SdfReader::finish() {
  if (!low_.allFinite()) low_ = high_ = Vector2d::Zero();
  for (const Gate& gate : gates_) reach({gate.from, gate.to});
  place_.gates = gates_;
  place_.gates_asked = !gates_.empty();
  lay_ground(file_.string(), {low_, high_}, std::move(flat_), place_);
  place_drones(file_.string(), place_);
}

void SdfReader::add_world(const sdf::World& world) {
  skip_unknown(world.Element(), "world " + world.Name());
  if (const auto* coordinates = world.SphericalCoordinates()) {
    latitude_deg_ = coordinates->LatitudeReference().Degree();
  }
  state_ = read_saved_state(world);
  note_state(world);
  const auto is_deleted = [&](const std::string& name) {
    return std::find(state_.deleted.begin(), state_.deleted.end(), name) != state_.deleted.end();
  };
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    const sdf::Model& model = *world.ModelByIndex(i);
    if (is_deleted(model.Name())) {
      skip(model.Element(), model.Name(), "deleted by the world's <state>");
    } else {
      add_model(model, Isometry3d::Identity(), "", state_.world.model(model.Name()));
    }
  }
  for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
    const sdf::Light& light = *world.LightByIndex(i);
    if (is_deleted(light.Name())) {
      skip(light.Element(), light.Name(), "deleted by the world's <state>");
    } else {
      add_light(light, Isometry3d::Identity(), "world");
    }
  }
  add_populations(world.Element());
  add_roads(world.Element());
  add_actors(world.Element());
}

ImportedScenario SdfReader::read() {
  sdf::Root root;
  text_ = load_root(file_, files_, root, place_.skipped);
  place_.name = scenario_name_from(file_);
  place_.description = fmt::format("Imported from {}.", file_.filename().string());
  if (root.WorldCount() == 0) {
    add_model(*root.Model(), Isometry3d::Identity(), "", nullptr);
  } else {
    const sdf::World& world = *root.WorldByIndex(0);
    if (root.WorldCount() > 1) {
      skip(world.Element(), "all worlds but the first", "one scenario each");
    }
    add_world(world);
  }
  finish();
  return std::move(place_);
}

ImportedScenario read_sdf(const fs::path& file, const SdfOptions& options) {
  return SdfReader(file, options).read();
}

}  // namespace throng::imports
