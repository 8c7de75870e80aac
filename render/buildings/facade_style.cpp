#include "render/buildings/facade_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace throng::render {

namespace {

using world::Facade;

using Row = std::pair<Facade, FacadeStyle>;

const std::array<Row, 6>& facade_styles() {
  static const std::array<Row, 6> kStyles = {{
      {Facade::plaster, {.surround_m = 0.1}},
      {Facade::brick, {.surround_m = 0.08, .brick = true}},
      {Facade::historic,
       {.bay_m = 2.3,
        .story_m = 3.6,
        .window_half_m = 0.52,
        .window_share = 0.58,
        .sill_share = 0.24,
        .panes_up = 2,
        .surround_m = 0.17,
        .course_m = 0.16,
        .every_course = true,
        .frame_light = 0.6}},
      {Facade::modern,
       {.bay_m = 3.4,
        .story_m = 3.1,
        .window_half_m = 1.25,
        .window_share = 0.52,
        .sill_share = 0.27,
        .panes_across = 3,
        .surround_m = 0,
        .course_m = 0,
        .frame_light = 0.08}},
      {Facade::concrete,
       {.bay_m = 3.0,
        .story_m = 2.8,
        .window_half_m = 0.85,
        .window_share = 0.5,
        .sill_share = 0.3,
        .surround_m = 0,
        .course_m = 0,
        .slabs = true}},
      {Facade::warehouse,
       {.bay_m = 4.0,
        .story_m = 4.2,
        .window_half_m = 1.25,
        .window_share = 0.58,
        .sill_share = 0.24,
        .panes_across = 5,
        .panes_up = 5,
        .surround_m = 0.12,
        .course_m = 0.3,
        .brick = true,
        .frame_light = 0.06}},
  }};
  return kStyles;
}

}  // namespace

const FacadeStyle& facade_style(Facade facade) {
  for (const auto& [value, style] : facade_styles()) {
    if (value == facade) return style;
  }
  return facade_styles().front().second;
}

FacadeGrid facade_grid(const FacadeStyle& style, double length_m, double height_m) {
  FacadeGrid grid;
  grid.bays = std::max(1, static_cast<int>(std::floor(length_m / style.bay_m + 0.5)));
  grid.stories = std::max(1, static_cast<int>(std::floor(height_m / style.story_m + 0.5)));
  grid.bay_m = length_m / grid.bays;
  grid.story_m = height_m / grid.stories;
  return grid;
}

std::string facade_words() {
  // The table by number of the facade: rows in between are those of plaster.
  constexpr int kRows = 14;
  std::string sizes;
  std::string windows;
  std::string trims;
  for (int i = 0; i < kRows; ++i) {
    const FacadeStyle& style = facade_style(static_cast<Facade>(i));
    const char* const comma = i + 1 < kRows ? "," : "";
    sizes += fmt::format("vec4({:.3f},{:.3f},{:.3f},{:.3f}){}", style.bay_m, style.story_m,
                         style.window_half_m, style.window_share, comma);
    windows += fmt::format("vec4({:.3f},{:.3f},{:.3f},{:.3f}){}", style.sill_share,
                           style.panes_across, style.panes_up, style.frame_light, comma);
    trims += fmt::format("vec4({:.3f},{:.3f},{:.1f},{:.1f}){}", style.surround_m,
                         style.every_course ? -style.course_m : style.course_m,
                         style.brick ? 1.0 : 0.0, style.slabs ? 1.0 : 0.0, comma);
  }
  return fmt::format(
      "const vec4 kFacadeSizes[{0}] = vec4[]({1});\nconst vec4 kFacadeWindows[{0}] = "
      "vec4[]({2});\nconst vec4 kFacadeTrims[{0}] = vec4[]({3});\n",
      kRows, sizes, windows, trims);
}

}  // namespace throng::render
