// Rendering quality levels, in one table. The job's keyword selects a row.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace throng::render {

enum class Quality : std::uint8_t { draft, standard, high };

/// A row of the table of quality levels.
struct QualitySettings {
  std::string_view word;  ///< keyword in job files
  bool textured;          ///< else ground and walls have a color per vertex
  int ground_texels;      ///< texels along each side of a tile of the ground's textures
  /// People at this number of the finest levels of detail are textured and lit per pixel. Among
  /// the people at coarser levels, whose triangles are about a pixel large, the nearest
  /// max(0, people_positions - people in view) are textured and lit per vertex; the others have a
  /// color per vertex.
  int textured_levels;
  int people_positions;
  int shadow_texels;  ///< texels along each side of the shadow map; 0: no shadows
  bool fine_shadows;  ///< shadows on ground and walls have the penumbra of the sun's disc
  /// Whether outlines of people and props are antialiased: on the CPU from the ids, on a GPU with
  /// kSamples samples per pixel.
  bool smooth_edges;
  int supersampling;  ///< color samples along each side of a pixel
  double detail;      ///< factor on people's image height in the choice of their levels of detail
};

/// Color samples per pixel on a GPU.
inline constexpr int kSamples = 4;

inline constexpr std::array<QualitySettings, 3> kQualities = {{
    {"draft", false, 0, 0, 0, 0, false, false, 1, 1},
    {"standard", true, 1024, 2, 700, 2048, false, true, 1, 1},
    {"high", true, 2048, 7, 0, 4096, true, false, 2, 2},
}};

constexpr const QualitySettings& quality_settings(Quality quality) {
  return kQualities[static_cast<std::size_t>(quality)];
}

/// Preprocessor lines for shaders/light.glsl: FINE_SHADOWS if `quality` has fine shadows.
constexpr std::string_view shadow_words(const QualitySettings& quality) {
  return quality.fine_shadows ? "#define FINE_SHADOWS\n" : "";
}

}  // namespace throng::render
