// Menge's files of navigation meshes (.nav).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "crowd/elements/shared_parts.h"
#include "crowd/elements/text_file.h"
#include "crowd/navigation/nav_mesh.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

struct NavMeshFile {
  NavMesh mesh;
  std::vector<std::string> groups;                     ///< by NavPolygon::group
  std::vector<std::vector<Eigen::Vector2f>> outlines;  ///< of the obstacles, solid on the left
};

/// Reads such a file: corners, portals, obstacles' edges and groups of polygons. Throws InputError
/// (file, line, found, expected), EnvironmentError when it cannot be read.
NavMeshFile load_nav_mesh(const TextFile& source);

/// The same, once per file.
std::shared_ptr<const NavMeshFile> shared_nav_mesh(const TextFile& source, SharedParts& parts);

}  // namespace throng::crowd
