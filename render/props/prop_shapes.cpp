#include "render/props/prop_shapes.h"

#include "render/props/plants.h"
#include "render/props/prop_builder.h"
#include "render/props/shape_file.h"
#include "render/props/trees.h"

namespace throng::render {

PropMesh prop_shape(const world::Prop& prop, std::uint32_t id) {
  PropBuilder builder(prop, id);
  switch (prop.kind) {
    case world::PropKind::tree:
      grow_tree(builder);
      break;
    case world::PropKind::bush:
      make_bush(builder);
      break;
    case world::PropKind::planter:
      make_planter(builder);
      break;
    default:
      add_shape(world::prop_type(prop.kind).name, builder);
  }
  return builder.take();
}

}  // namespace throng::render
