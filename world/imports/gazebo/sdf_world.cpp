#include "world/imports/gazebo/sdf_world.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sdf/sdf.hh>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/geometry/rectangle.h"
#include "world/imports/gazebo/camera_sensor.h"
#include "world/imports/gazebo/local_files.h"
#include "world/imports/gazebo/sdf_pose.h"
#include "world/imports/gazebo/sdf_root.h"
#include "world/imports/gazebo/sdf_shapes.h"
#include "world/imports/gazebo/world_fixtures.h"
#include "world/imports/gazebo/world_ground.h"
#include "world/imports/gazebo/world_sun.h"
#include "world/imports/parts/populate.h"
#include "world/imports/parts/scenario_writer.h"

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
  static const Words kWorld = {
      "model", "light", "frame", "gravity", "magnetic_field", "include", "spherical_coordinates"};
  static const Words kModel = {
      "pose",        "static", "link", "model", "frame", "self_collide", "allow_auto_disable",
      "enable_wind", "include"};
  static const Words kLink = {"pose",    "visual",         "collision",         "inertial",
                              "gravity", "kinematic",      "enable_wind",       "self_collide",
                              "light",   "velocity_decay", "must_be_base_link", "sensor"};
  return parent == "world" ? kWorld : parent == "model" ? kModel : kLink;
}

class SdfReader {
 public:
  SdfReader(const fs::path& file, const SdfOptions& options)
      : file_(file), gates_(options.gates), files_(folders_of(file, options)) {}

  ImportedScenario read();

 private:
  static std::vector<fs::path> folders_of(const fs::path& file, const SdfOptions& options) {
    std::vector<fs::path> folders = options.models;
    // The folders of models in repositories of worlds.
    folders.push_back(file.parent_path() / "models");
    folders.push_back(file.parent_path() / ".." / "models");
    folders.insert(folders.begin(), file.parent_path());
    return folders;
  }

  void skip(const sdf::ElementPtr& element, const std::string& what, const std::string& why);
  void skip_unknown(const sdf::ElementPtr& parent, const std::string& path);
  std::optional<Isometry3d> resolve(const sdf::SemanticPose& pose, const Isometry3d& parent,
                                    const sdf::ElementPtr& element, const std::string& path);
  void add_model(const sdf::Model& model, const Isometry3d& parent, const std::string& path);
  void add_link(const sdf::Link& link, const Isometry3d& model, const std::string& path,
                Object& object);
  void add_light(const sdf::Light& light, const Isometry3d& parent, const std::string& path);
  void add_sun(const sdf::Light& light, const Isometry3d& parent, const std::string& name);
  void add_sensor(const sdf::Sensor& sensor, const Isometry3d& link, const std::string& path);
  template <typename Owner>
  std::optional<Body> body(const Owner& owner, const Isometry3d& link, const std::string& path);
  void add_seen(Body body, const Vector3d* rgb, Object& object);
  void add_in_the_way(const Body& body);
  void reach(const Corners& corners);
  void add_building(const Body& body);
  void finish();

  fs::path file_;
  std::vector<Gate> gates_;
  LocalFiles files_;
  std::optional<SdfText> text_;
  ImportedScenario place_;
  std::vector<geometry::Rectangle> building_bounds_;
  std::vector<FlatArea> flat_;
  Vector2d low_ = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high_ = -low_;
  double latitude_deg_ = 45;  // as jobs have it without any
  std::size_t bodies_ = 0;
  std::size_t triangles_ = 0;
};

void SdfReader::skip(const sdf::ElementPtr& element, const std::string& what,
                     const std::string& why) {
  Skipped skipped{file_.string(), 0, what, why};
  if (element) {
    const int line = element->LineNumber().value_or(0);
    const bool own = is_given_text(element->FilePath());
    if (!own) skipped.file = element->FilePath();
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
    const std::string from = owner.Element() ? owner.Element()->FilePath() : "";
    found = make_body(*owner.Geom(), *pose, is_given_text(from) ? file_.string() : from, files_);
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

/// The first directional light becomes the sun of the draft job.
void SdfReader::add_sun(const sdf::Light& light, const Isometry3d& parent,
                        const std::string& name) {
  if (!place_.environment.is_null()) {
    return skip(light.Element(), name, "another directional light than the first, the sun");
  }
  const auto pose = resolve(light.SemanticPose(), Isometry3d::Identity(), light.Element(), name);
  if (!pose) return;
  const ignition::math::Vector3d shines = light.Direction();
  const Vector3d towards_light =
      parent.linear() * pose->linear() * Vector3d(-shines.X(), -shines.Y(), -shines.Z());
  const auto sun = sun_like(towards_light, latitude_deg_);
  if (!sun) return skip(light.Element(), name, "shines from below 3 degrees, as no sun by day");
  const auto minutes = static_cast<int>(std::lround(60 * sun->time_of_day_h));
  place_.environment = {{"latitude_deg", sun->latitude_deg},
                        {"day_of_year", sun->day_of_year},
                        {"time_of_day", fmt::format("{:02}:{:02}", minutes / 60, minutes % 60)}};
  constexpr double kNear = 2 * kDegree;
  if (sun->error_rad <= kNear) return;
  skip(light.Element(), name,
       fmt::format("the sun of the job stands {:.0f} degrees beside it, as near as at a latitude "
                   "of {:g} degrees",
                   sun->error_rad / kDegree, sun->latitude_deg));
}

void SdfReader::add_sensor(const sdf::Sensor& sensor, const Isometry3d& link,
                           const std::string& path) {
  const std::string name = fmt::format("{}/{} <sensor>", path, sensor.Name());
  if (!is_camera(sensor)) {
    return skip(sensor.Element(), name,
                fmt::format("a scenario has no sensor of the type {}", sensor.TypeStr()));
  }
  if (const auto why = add_camera(sensor, link, place_)) return skip(sensor.Element(), name, *why);
  reach({place_.drones.back().position.head<2>()});
}

void SdfReader::add_light(const sdf::Light& light, const Isometry3d& parent,
                          const std::string& path) {
  const std::string name = path + "/" + light.Name();
  if (light.Type() == sdf::LightType::DIRECTIONAL) return add_sun(light, parent, name);
  const auto pose = resolve(light.SemanticPose(), parent, light.Element(), name);
  if (!pose) return;
  constexpr double kLampM = 4.6;  // of a prop of scale 1
  const double height = pose->translation().z();
  if (!(height >= 2 && height <= 12)) {
    return skip(light.Element(), name, "only lamps 2 to 12 m above the ground become lamp posts");
  }
  world::Prop lamp;
  lamp.kind = world::PropKind::lamp_post;
  lamp.position = pose->translation().head<2>();
  lamp.scale = height / kLampM;
  place_.props.push_back(lamp);
}

void SdfReader::add_link(const sdf::Link& link, const Isometry3d& model, const std::string& path,
                         Object& object) {
  const std::string name = path + "/" + link.Name();
  const auto pose = resolve(link.SemanticPose(), model, link.Element(), name);
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
                          const std::string& path) {
  const std::string name = path.empty() ? model.Name() : path + "/" + model.Name();
  const auto pose = resolve(model.SemanticPose(), parent, model.Element(), name);
  if (!pose) return;
  if (is_robot(model)) {
    add_robot(model, *pose, place_);
    return reach({pose->translation().head<2>()});
  }
  skip_unknown(model.Element(), name);
  if (model.LinkCount() + model.ModelCount() == 0) skip(model.Element(), name, "has no links");
  Object object{name, {}};
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    add_link(*model.LinkByIndex(i), *pose, name, object);
  }
  if (!object.solids.empty()) place_.objects.push_back(std::move(object));
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    add_model(*model.ModelByIndex(i), *pose, name);
  }
}

void SdfReader::finish() {
  if (!low_.allFinite()) low_ = high_ = Vector2d::Zero();
  for (const Gate& gate : gates_) reach({gate.from, gate.to});
  place_.gates = gates_;
  place_.gates_asked = !gates_.empty();
  lay_ground(file_.string(), {low_, high_}, std::move(flat_), place_);
  place_drones(file_.string(), place_);
}

ImportedScenario SdfReader::read() {
  sdf::Root root;
  text_ = load_root(file_, files_, root, place_.skipped);
  place_.name = scenario_name_from(file_);
  place_.description = fmt::format("Imported from {}.", file_.filename().string());
  if (root.WorldCount() == 0) {
    add_model(*root.Model(), Isometry3d::Identity(), "");
  } else {
    const sdf::World& world = *root.WorldByIndex(0);
    if (root.WorldCount() > 1)
      skip(world.Element(), "all worlds but the first", "one scenario each");
    skip_unknown(world.Element(), "world " + world.Name());
    if (const auto* coordinates = world.SphericalCoordinates()) {
      latitude_deg_ = coordinates->LatitudeReference().Degree();
    }
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      add_model(*world.ModelByIndex(i), Isometry3d::Identity(), "");
    }
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      add_light(*world.LightByIndex(i), Isometry3d::Identity(), "world");
    }
  }
  finish();
  return std::move(place_);
}

}  // namespace

ImportedScenario read_sdf(const fs::path& file, const SdfOptions& options) {
  return SdfReader(file, options).read();
}

}  // namespace throng::imports
