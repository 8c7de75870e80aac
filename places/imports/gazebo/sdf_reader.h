// Reads a world of Gazebo element by element: the state that the import of a world needs between
// them.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <limits>
#include <optional>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "base/geometry/rectangle.h"
#include "places/imports/gazebo/saved_state.h"
#include "places/imports/gazebo/sdf_options.h"
#include "places/imports/gazebo/sdf_shapes.h"
#include "places/imports/gazebo/world_ground.h"
#include "places/imports/parts/imported_scenario.h"
#include "places/imports/sdf/local_files.h"
#include "places/imports/sdf/sdf_text.h"

namespace throng::imports {

class SdfReader {
 public:
  SdfReader(const std::filesystem::path& file, const SdfOptions& options);

  ImportedScenario read();

 private:
  void skip(const sdf::ElementPtr& element, const std::string& what, const std::string& why);
  void skip_unknown(const sdf::ElementPtr& parent, const std::string& path);
  std::optional<Eigen::Isometry3d> resolve(const sdf::SemanticPose& pose,
                                           const Eigen::Isometry3d& parent,
                                           const sdf::ElementPtr& element, const std::string& path);
  void add_world(const sdf::World& world);
  void add_model(const sdf::Model& model, const Eigen::Isometry3d& parent, const std::string& path,
                 const EntityState* state);
  void add_link(const sdf::Link& link, const Eigen::Isometry3d& model, const std::string& path,
                Object& object, const EntityState* state);
  std::optional<Eigen::Isometry3d> light_pose(const sdf::Light& light,
                                              const Eigen::Isometry3d& parent,
                                              const std::string& name);
  void add_light(const sdf::Light& light, const Eigen::Isometry3d& parent, const std::string& path);
  void add_sun(const sdf::Light& light, const Eigen::Isometry3d& parent, const std::string& name);
  void add_sensor(const sdf::Sensor& sensor, const Eigen::Isometry3d& link,
                  const std::string& path);
  template <typename Owner>
  std::optional<Body> body(const Owner& owner, const Eigen::Isometry3d& link,
                           const std::string& path);
  void add_seen(Body body, const Eigen::Vector3d* rgb, Object& object);
  void add_in_the_way(const Body& body);
  void reach(const Corners& corners);
  void add_building(const Body& body);
  void note_state(const sdf::World& world);
  void add_roads(const sdf::ElementPtr& world);
  void add_populations(const sdf::ElementPtr& world);
  void add_copies(const sdf::ElementPtr& population, const std::string& name);
  void add_actors(const sdf::ElementPtr& world);
  void finish();

  std::filesystem::path file_;
  std::vector<Gate> gates_;
  LocalFiles files_;
  std::optional<SdfText> text_;
  SavedState state_;
  ImportedScenario place_;
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();  ///< of the model that is read
  sdf::ElementPtr copied_;                           ///< the <population> whose copies are read
  std::string copied_from_;                          ///< the file of the model that it copies
  std::vector<geometry::Rectangle> building_bounds_;
  std::vector<FlatArea> flat_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high_ = -low_;
  double latitude_deg_ = 45;  // as jobs have it without any
  std::size_t bodies_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace throng::imports
