// Rendering quality levels, in one table. The job's keyword selects a row.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace throng::render {

enum class Quality : std::uint8_t { draft, standard, high };

struct QualitySettings {
  std::string_view word;  ///< in job files
  bool textured;          ///< else ground and walls are colored corner by corner
  int ground_texels;      ///< along each side of a tile of the ground's textures
  /// People at so many of the finest levels of detail are textured and lit pixel by pixel. Of the
  /// others, whose triangles are pixels, the nearest are textured: as many as leave room for all in
  /// view, if who is textured takes two of so many places. The rest are colored corner by corner.
  int textured_levels;
  int people_positions;
  int shadow_texels;  ///< along each side of the shadow map; 0: no shadows
  bool fine_shadows;  ///< edges on ground and walls as soft as the sun's disc makes them
  /// Along the outlines of people and props: on the CPU from the ids, on a GPU with kSamples a
  /// pixel.
  bool smooth_edges;
  int supersampling;      ///< samples of color along each side of a pixel
  double detail;          ///< people's levels of detail are chosen as if they were so much larger
  double proxy_below_px;  ///< smaller people are rendered at their last level
};

/// Samples of color per pixel on a GPU.
inline constexpr int kSamples = 4;

inline constexpr std::array<QualitySettings, 3> kQualities = {{
    {"draft", false, 0, 0, 0, 0, false, false, 1, 0.5, 60},
    {"standard", true, 1024, 2, 700, 2048, false, true, 1, 1, 0},
    {"high", true, 2048, 7, 0, 4096, true, false, 2, 2, 0},
}};

constexpr const QualitySettings& quality_settings(Quality quality) {
  return kQualities[static_cast<std::size_t>(quality)];
}

/// Lines "#define WORD" for shaders/light.glsl.
constexpr std::string_view shadow_words(const QualitySettings& quality) {
  return quality.fine_shadows ? "#define FINE_SHADOWS\n" : "";
}

}  // namespace throng::render
