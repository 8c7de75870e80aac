#include "crowd/navigation/elevation.h"

#include "crowd/navigation/nav_mesh_file.h"

namespace throng::crowd {

namespace {

class Flat : public Elevation {
 public:
  float height_m(const Eigen::Vector2f&) const override { return 0; }
  Eigen::Vector2f gradient(const Eigen::Vector2f&) const override {
    return Eigen::Vector2f::Zero();
  }
};

/// The planes of a mesh's polygons; beside the mesh, those of the nearest.
class OfMesh : public Elevation {
 public:
  explicit OfMesh(std::shared_ptr<const NavMeshFile> file) : file_(std::move(file)) {}
  float height_m(const Eigen::Vector2f& point) const override {
    const NavMesh::Location place = place_of(point);
    const Eigen::Vector3f& plane = file_->mesh[place.polygon].plane;
    return plane.x() * place.point.x() + plane.y() * place.point.y() + plane.z();
  }
  Eigen::Vector2f gradient(const Eigen::Vector2f& point) const override {
    return file_->mesh[place_of(point).polygon].plane.head<2>();
  }

 private:
  NavMesh::Location place_of(const Eigen::Vector2f& point) const {
    const int polygon = file_->mesh.find(point);
    return polygon >= 0 ? NavMesh::Location{polygon, point} : file_->mesh.nearest(point);
  }

  std::shared_ptr<const NavMeshFile> file_;
};

std::unique_ptr<Elevation> make_flat(const Element&, const Attributes&, ElevationContext&) {
  return std::make_unique<Flat>();
}

std::unique_ptr<Elevation> make_of_mesh(const Element& element, const Attributes& attributes,
                                        ElevationContext& context) {
  return std::make_unique<OfMesh>(
      shared_nav_mesh(element.text_file(attributes.text("file_name")), context.parts));
}

}  // namespace

const ElevationRegistry& elevation_registry() {
  static const ElevationRegistry kRegistry({{
      {"flat", "level ground", {}, make_flat},
      {"nav_mesh",
       "the planes of a navigation mesh's polygons",
       {text("file_name", "of the mesh (.nav)")},
       make_of_mesh},
      height_field_elevation(),
  }});
  return kRegistry;
}

}  // namespace throng::crowd
