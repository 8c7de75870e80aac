// The floor plan of a scenario: what it looks like to who makes it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "world/drone_path.h"
#include "world/scenario.h"

namespace throng::places {

/// A color of a plan, 0 to 255 and how much of what is below it hides, 0 to 1.
struct Ink {
  std::array<std::uint8_t, 3> rgb{};
  double opacity = 1;
};

/// Something on a plan; places and widths in pixels, y down. A text stands at its first point, a
/// circle is about it; anything else is a polygon or, where it has no fill, a line.
struct Mark {
  enum class Kind : std::uint8_t { polygon, line, circle, text };
  Kind kind = Kind::polygon;
  std::vector<Eigen::Vector2d> points;
  Ink fill{{0, 0, 0}, 0};
  Ink stroke{{0, 0, 0}, 0};
  double width_px = 1;  ///< of the stroke; of a circle: its radius
  std::string text;     ///< and its size is width_px
  bool arrow = false;   ///< a line with a head at its end
};

/// A picture made of marks, the later ones over the earlier ones.
struct Drawing {
  int width_px = 0;
  int height_px = 0;
  std::vector<Mark> marks;
};

/// Ground, buildings, obstacles, props, exits with ids and widths, goals, where people start and
/// come in and how many, how many have which exit as their nearest, a scale and north (+y), a
/// legend; and the paths of a job's drones or, without a job, where the scenario has its drones
/// start. `size_px` is its longer side without the legend. Throws as load_crowd_of().
Drawing draw_plan(const world::Scenario& scenario, int size_px,
                  std::span<const world::DronePath> paths = {});

/// The drawing as an SVG document.
std::string to_svg(const Drawing& drawing);

/// The drawing as a PNG file.
std::string to_png(const Drawing& drawing);

/// Writes the drawing as what the file's suffix says, .svg or .png. Throws InputError for another
/// suffix, EnvironmentError when it cannot be written.
void write_plan(const Drawing& drawing, const std::filesystem::path& file);

}  // namespace throng::places
