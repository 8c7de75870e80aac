// Height of the ground.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "crowd/elements/registry.h"
#include "crowd/elements/shared_parts.h"

namespace throng::crowd {

/// The height of the ground as a function of the position.
class Elevation {
 public:
  virtual ~Elevation() = default;
  virtual float height_m(const Eigen::Vector2f& point) const = 0;
  /// Gradient of the height (m/m); points uphill.
  virtual Eigen::Vector2f gradient(const Eigen::Vector2f& point) const = 0;
};

struct ElevationContext {
  SharedParts& parts;
};
using ElevationRegistry = Registry<Elevation, ElevationContext>;
/// Types: flat, nav_mesh, height_field.
const ElevationRegistry& elevation_registry();

ElevationRegistry::Entry height_field_elevation();

}  // namespace throng::crowd
