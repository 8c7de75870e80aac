#include "places/imports/gazebo/gazebo_colors.h"

#include <array>

namespace throng::imports {

using Eigen::Vector3d;

std::optional<Vector3d> gazebo_color(std::string_view script) {
  struct Named {
    std::string_view start;  // of the name: RedBright and RedTransparent are red, too
    std::array<double, 3> rgb;
  };
  // Longer names before those that they begin with.
  constexpr std::array<Named, 33> kColors = {{{"DarkGrey", {0.18, 0.18, 0.18}},
                                              {"DarkYellow", {0.7, 0.7, 0}},
                                              {"DarkOrange", {0.7, 0.25, 0}},
                                              {"DarkMagenta", {0.5, 0, 0.5}},
                                              {"LightBlueLaser", {0.5, 0.5, 1}},
                                              {"LightOn", {0, 1, 0}},
                                              {"LightOff", {1, 0, 0}},
                                              {"Grey", {0.7, 0.7, 0.7}},
                                              {"Gray", {0.7, 0.7, 0.7}},
                                              {"White", {1, 1, 1}},
                                              {"FlatBlack", {0.1, 0.1, 0.1}},
                                              {"Black", {0.02, 0.02, 0.02}},
                                              {"Red", {1, 0, 0}},
                                              {"Green", {0, 1, 0}},
                                              {"Blue", {0, 0, 1}},
                                              {"SkyBlue", {0.13, 0.44, 0.7}},
                                              {"Yellow", {1, 1, 0}},
                                              {"ZincYellow", {0.97, 0.95, 0.21}},
                                              {"Orange", {1, 0.5, 0.05}},
                                              {"Purple", {1, 0, 1}},
                                              {"Turquoise", {0, 1, 1}},
                                              {"Indigo", {0.33, 0, 0.5}},
                                              {"Gold", {0.8, 0.65, 0.12}},
                                              {"Wood", {0.45, 0.3, 0.16}},
                                              {"Bricks", {0.45, 0.22, 0.15}},
                                              {"Road", {0.15, 0.15, 0.15}},
                                              {"Residential", {0.25, 0.25, 0.25}},
                                              {"Tertiary", {0.2, 0.2, 0.2}},
                                              {"Pedestrian", {0.5, 0.5, 0.5}},
                                              {"Footway", {0.5, 0.5, 0.5}},
                                              {"Grass", {0.15, 0.3, 0.08}},
                                              {"CeilingTiled", {0.8, 0.8, 0.78}},
                                              {"PaintedWall", {0.75, 0.73, 0.68}}}};
  constexpr std::string_view kGazebo = "Gazebo/";
  const std::size_t at = script.find(kGazebo);
  if (at == std::string_view::npos) return std::nullopt;
  script.remove_prefix(at + kGazebo.size());
  for (const Named& named : kColors) {
    if (script.starts_with(named.start)) {
      return Vector3d(named.rgb[0], named.rgb[1], named.rgb[2]);
    }
  }
  return std::nullopt;
}

}  // namespace throng::imports
