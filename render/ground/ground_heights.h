// Heights of the layers of the ground (m): all below people's soles (kAboveGround, 2 mm) and far
// enough apart for the depth buffer.
#pragma once

namespace throng::render::ground_height {

inline constexpr double kAreaM = 0.0006;         ///< of areas that lie on no other
inline constexpr double kNextM = 0.00016;        ///< of an area above the one below it
inline constexpr int kMaxLevels = 5;             ///< further areas are as high as the last
inline constexpr double kBandM = 0.000054;       ///< of bands of setts above their area
inline constexpr double kWallStripM = 0.000107;  ///< of setts along walls above their area
inline constexpr double kMownM = 0.00151;        ///< of mown stripes
inline constexpr double kGutterM = 0.00157;
inline constexpr double kKerbM = 0.00163;
inline constexpr double kTactileM = 0.00169;
inline constexpr double kPaintM = 0.00176;
inline constexpr double kDecalM =
    0.00183;  ///< contact shadows are above (shaders/contact.vert.glsl)

}  // namespace throng::render::ground_height
