// The <population> of a world: copies of a model in a region.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

namespace sdf {
inline namespace v12 {
class Element;
class Root;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// The copies of a model.
struct ModelCopies {
  std::vector<Eigen::Isometry3d> poses;  ///< in the world's frame
  std::string unread;                    ///< why there are none, or not all
};

/// Places the copies of a <population>: at random (the same ones whenever it is read), on a grid,
/// or on a line, in a box or a cylinder. At most 1000. `stated_kind` is the text of its
/// <distribution>, which old worlds have instead of a <type>; "": none.
ModelCopies place_copies(const std::shared_ptr<sdf::Element>& population,
                         const std::string& stated_kind);

/// Loads a model element by itself. Returns false if it is no model.
bool load_model(const std::shared_ptr<sdf::Element>& model, sdf::Root& root);

}  // namespace throng::imports
