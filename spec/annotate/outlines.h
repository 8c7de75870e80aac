// Measures of outlines in annotations, shared by the code that writes and that checks them.
#pragma once

namespace throng::annotate {

/// Sides of the polygon that stands for the circle of a hazard.
inline constexpr int kHazardSides = 48;

/// Images of distorting lenses know people beyond their borders up to their width (height) divided
/// by this; those of pinhole cameras up to their whole size.
inline constexpr int kLensMarginDivisor = 4;

}  // namespace throng::annotate
