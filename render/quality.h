// What a picture's quality means, in one table. The job's word picks a row.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace throng::render {

enum class Quality : std::uint8_t { draft, standard, high };

struct QualitySettings {
  std::string_view word;  ///< in job files
  bool textured;          ///< else ground, walls and people are coloured corner by corner
  int shadow_texels;      ///< along each side of the shadow map; 0: no shadows
  bool smooth_edges;      ///< along the outlines of people and things
  int supersampling;      ///< samples of colour along each side of a pixel
  double detail;          ///< people's levels of detail are chosen as if they were so much larger
  double proxy_below_px;  ///< smaller people are drawn with kProxyTriangles
};

/// Triangles of the coarsest people: also what casts people's shadows.
inline constexpr int kProxyTriangles = 100;

inline constexpr std::array<QualitySettings, 3> kQualities = {{
    {"draft", false, 0, false, 1, 0.5, 60},
    {"standard", true, 2048, true, 1, 1, 0},
    {"high", true, 4096, false, 2, 2, 0},
}};

constexpr const QualitySettings& settings_of(Quality quality) {
  return kQualities[static_cast<std::size_t>(quality)];
}

}  // namespace throng::render
