// Conversion of objects to Wavefront OBJ with materials.
#pragma once

#include <string>

#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// The two files of an object.
struct MeshText {
  std::string triangles;  ///< the .obj, with y up: the scenario's (x, y, z) becomes (x, z, -y)
  std::string materials;  ///< the .mtl
};

MeshText mesh_text(const Object& object, const std::string& materials_file);

/// The unique path of an object's files relative to the scenario's folder, without suffix.
std::string mesh_name(const ImportedScenario& scenario, std::size_t object);

}  // namespace throng::imports
