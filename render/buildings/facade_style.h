// The dimensions of facades: one table for the geometry and for shaders/wall.frag.glsl.
// Independent of GL.
#pragma once

#include <cstddef>
#include <string>

#include "world/building.h"

namespace throng::render {

struct FacadeStyle {
  double bay_m = 2.8;          ///< about the distance between windows
  double story_m = 3.3;        ///< about the height of a story
  double window_half_m = 0.6;  ///< half of a window's width
  double window_share = 0.5;   ///< height of a window by that of the story
  double sill_share = 0.29;    ///< of the story, below a window
  double panes_across = 2;
  double panes_up = 1;
  double surround_m = 0.1;    ///< width of the frame of stone or stucco around a window
  double course_m = 0.2;      ///< height of the band above the ground floor, or above each story
  bool every_course = false;  ///< above each story
  bool brick = false;
  bool slabs = false;        ///< joints between slabs at bays and stories
  double frame_light = 0.5;  ///< albedo of window frames
};

/// The style of a facade that has stories and is not of glass.
const FacadeStyle& facade_style(world::Facade facade);

/// Bays and stories of a front.
struct FacadeGrid {
  int bays = 1;
  int stories = 1;
  double bay_m = 1;
  double story_m = 1;
};

/// The grid of a front of this length and height (m), as the shader has it.
FacadeGrid facade_grid(const FacadeStyle& style, double length_m, double height_m);

/// The table as constants of GLSL.
std::string facade_words();

}  // namespace throng::render
