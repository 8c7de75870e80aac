// Small worlds for tests, and what became of them.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "places/imports/gazebo/sdf_world.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports_testing {

/// A static model of one link that is seen and felt as a box; its lower side is at z = 0.
inline std::string box_model(const std::string& name, double x, double y, double z,
                             const std::string& pose = "0 0 0 0 0 0") {
  const std::string shape =
      fmt::format("<geometry><box><size>{} {} {}</size></box></geometry>", x, y, z);
  return fmt::format(
      "<model name='{}'><static>true</static><pose>{}</pose><link name='l'><pose>0 0 {} 0 0 0"
      "</pose><collision name='c'>{}</collision><visual name='v'>{}</visual></link></model>\n",
      name, pose, 0.5 * z, shape, shape);
}

/// The world with these elements, beside a folder "models" with the model "hut": 2 m x 2 m x 6 m.
inline imports::ImportedScenario read_world_text(const std::string& body,
                                                 const std::string& version = "1.6") {
  const throng::testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "models/hut/model.config",
                        "<model><name>hut</name><sdf version='1.6'>model.sdf</sdf></model>");
  write_file_atomically(folder.path() / "models/hut/model.sdf",
                        "<sdf version='1.6'>" + box_model("hut", 2, 2, 6) + "</sdf>");
  write_file_atomically(folder.path() / "w.world",
                        fmt::format("<?xml version='1.0'?>\n<sdf version='{}'><world name='w'>\n{}"
                                    "</world></sdf>\n",
                                    version, body));
  return imports::read_sdf(folder.path() / "w.world", {});
}

/// The message with which a world is refused; "accepted" if it is not.
inline std::string world_error(const std::string& body) {
  try {
    read_world_text(body);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

inline const world::Building* building_at(const imports::ImportedScenario& scenario,
                                          const Eigen::Vector2d& point) {
  for (const world::Building& building : scenario.buildings) {
    if (geometry::distance_to(building.footprint, point) == 0) return &building;
  }
  return nullptr;
}

/// Whether something was listed as skipped with these words.
inline bool is_listed(const imports::ImportedScenario& scenario, const std::string& words) {
  return std::any_of(
      scenario.skipped.begin(), scenario.skipped.end(),
      [&](const imports::Skipped& one) { return one.text().find(words) != std::string::npos; });
}

}  // namespace throng::imports_testing
