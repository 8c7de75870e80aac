// The texts of shaders/, compiled into the program.
#pragma once

#include <string_view>

namespace throng::embedded {

extern const std::string_view kShaderView;
extern const std::string_view kShaderLight;
extern const std::string_view kShaderNoise;
extern const std::string_view kShaderPersonVert;
extern const std::string_view kShaderPersonFrag;
extern const std::string_view kShaderPlaceVert;
extern const std::string_view kShaderPlaceShadowVert;
extern const std::string_view kShaderGroundFrag;
extern const std::string_view kShaderGroundPavers;
extern const std::string_view kShaderGroundAsphalt;
extern const std::string_view kShaderGroundGrass;
extern const std::string_view kShaderGroundConcrete;
extern const std::string_view kShaderGroundSurroundings;
extern const std::string_view kShaderWallFrag;
extern const std::string_view kShaderRoofFrag;

}  // namespace throng::embedded
