// Objects as Wavefront OBJ with its materials.
#pragma once

#include <string>

#include "world/imports/parts/imported_scenario.h"

namespace throng::imports {

struct MeshText {
  std::string triangles;  ///< the .obj; y up, so that the scenario's (x, y, z) is (x, z, -y)
  std::string materials;  ///< the .mtl
};

MeshText mesh_text(const Object& object, const std::string& materials_file);

/// Path of an object's files below the scenario's folder, without suffix; unique.
std::string mesh_name(const ImportedScenario& scenario, std::size_t object);

}  // namespace throng::imports
