// Rendering with any lens. The renderer makes pinhole images; for a lens with distortion, a
// sufficiently wide pinhole image is rendered and resampled.
#pragma once

#include <memory>
#include <vector>

#include "camera/camera.h"
#include "render/frame/frame.h"
#include "render/lens/lens_map.h"
#include "render/people/person_geometry.h"
#include "render/renderer.h"

namespace throng::render {

/// Renders with cameras of any lens. Colors are interpolated; ids, depth, normals, parts and flow
/// are those of the nearest pixel of the wide image. Depth is the camera's z, flow is that of the
/// distorted image. Boxes are those of the skinned vertices projected through the lens, areas count
/// pixels of the distorted image; both are computed up to a quarter of the image size beyond its
/// borders. Pinhole cameras are rendered directly. The renderer and its population must outlive
/// this object.
class Lens {
 public:
  Lens(Renderer& renderer, const skinning::Population& population);
  ~Lens();
  Lens(const Lens&) = delete;
  Lens& operator=(const Lens&) = delete;

  /// Renders a frame. `next` is used for flow only.
  Frame draw(const Scene& scene, const camera::Camera& camera, const NeighborFrame* next = nullptr);

  /// Renders only these rows, which are the frame's buffers. The frame's camera is that of the
  /// whole image; boxes of people and objects are in the coordinates of the whole image and cover
  /// the parts in these rows. Unless these are all rows, people and objects of which only parts
  /// beside the image are in these rows are listed, too. DrawChoice::weights are ignored.
  Frame draw_rows(const Scene& scene, const camera::Camera& camera, const Rows& rows,
                  const NeighborFrame* next = nullptr, const DrawChoice& choice = {});

  /// Reuses the memory of a frame that is no longer needed.
  void recycle(Frame&& frame);

  Renderer& renderer() { return *renderer_; }

 private:
  struct Known;

  const LensMap& map_of(const camera::Intrinsics& lens, const Rows& rows);
  void measure_boxes(const Scene& scene, const Rows& rows, Frame& frame) const;

  Renderer* renderer_;
  const skinning::Population* population_;
  std::vector<std::unique_ptr<Known>> known_;
};

}  // namespace throng::render
