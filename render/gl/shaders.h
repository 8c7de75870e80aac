// The texts of the files in shaders/, embedded in the program.
#pragma once

#include <string_view>

// NOLINTBEGIN(readability-identifier-naming): named after their files
namespace throng::embedded {

extern const std::string_view shader_view;
extern const std::string_view shader_light;
extern const std::string_view shader_noise;
extern const std::string_view shader_person_vert;
extern const std::string_view shader_distant_vert;
extern const std::string_view shader_distant_frag;
extern const std::string_view shader_person_frag;
extern const std::string_view shader_person_surface_frag;
extern const std::string_view shader_coverage_frag;
extern const std::string_view shader_silhouette;
extern const std::string_view shader_next_view;
extern const std::string_view shader_scenery_corners_vert;
extern const std::string_view shader_corners_frag;
extern const std::string_view shader_contact_vert;
extern const std::string_view shader_contact_frag;
extern const std::string_view shader_scenery_vert;
extern const std::string_view shader_scenery_shadow_vert;
extern const std::string_view shader_ground_frag;
extern const std::string_view shader_ground_tile;
extern const std::string_view shader_ground_bake_vert;
extern const std::string_view shader_ground_bake_frag;
extern const std::string_view shader_ground_pavers;
extern const std::string_view shader_ground_asphalt;
extern const std::string_view shader_ground_grass;
extern const std::string_view shader_ground_concrete;
extern const std::string_view shader_ground_dirt;
extern const std::string_view shader_ground_kerb;
extern const std::string_view shader_ground_paint;
extern const std::string_view shader_ground_surroundings;
extern const std::string_view shader_ground_setts;
extern const std::string_view shader_ground_tactile;
extern const std::string_view shader_ground_decals;
extern const std::string_view shader_ids_frag;
extern const std::string_view shader_leaf_ids_frag;
extern const std::string_view shader_leaf_shadow_vert;
extern const std::string_view shader_leaf_shadow_frag;
extern const std::string_view shader_prop_vert;
extern const std::string_view shader_prop_frag;
extern const std::string_view shader_wall_frag;
extern const std::string_view shader_roof_frag;
extern const std::string_view shader_screen;
extern const std::string_view shader_sky_vert;
extern const std::string_view shader_sky_frag;
extern const std::string_view shader_smoke_vert;
extern const std::string_view shader_smoke_frag;
extern const std::string_view shader_beam_vert;
extern const std::string_view shader_beam_frag;
extern const std::string_view shader_rain_vert;
extern const std::string_view shader_rain_frag;

}  // namespace throng::embedded
// NOLINTEND(readability-identifier-naming)
