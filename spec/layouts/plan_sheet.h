// Measures of the drawing of a floor plan, in pixels of the drawing. From top to bottom: the title,
// a border, the ground, a border, the scale and the legend.
#pragma once

namespace throng::layouts {

inline constexpr int kPlanPx = 1200;  ///< the longer side of the ground
inline constexpr int kPlanBorderPx = 20;
inline constexpr int kPlanTitlePx = 30;
inline constexpr int kLegendLinePx = 22;
inline constexpr int kLegendColumnPx = 200;
inline constexpr int kLegendEntries = 10;
inline constexpr int kMinPlanWidthPx = 640;  ///< the legend needs as much

}  // namespace throng::layouts
