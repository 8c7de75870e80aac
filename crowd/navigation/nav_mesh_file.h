// Menge's navigation mesh files (.nav).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "crowd/elements/shared_parts.h"
#include "crowd/elements/text_file.h"
#include "crowd/navigation/nav_mesh.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// Content of a file.
struct NavMeshFile {
  NavMesh mesh;
  std::vector<std::string> groups;                     ///< names, indexed by NavPolygon::group
  std::vector<std::vector<Eigen::Vector2f>> outlines;  ///< outlines of obstacles, solid on the left
};

/// Reads corners, portals, edges of obstacles and groups of polygons. Throws InputError (file,
/// line, found, expected), EnvironmentError if the file cannot be read.
NavMeshFile load_nav_mesh(const TextFile& source);

/// Returns the mesh of a file, which is read once.
std::shared_ptr<const NavMeshFile> shared_nav_mesh(const TextFile& source, SharedParts& parts);

}  // namespace throng::crowd
