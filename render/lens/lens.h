// Images through any lens. A renderer renders pinhole images; for a lens that distorts, a pinhole
// image that is wide enough is rendered and looked up pixel by pixel.
#pragma once

#include <memory>
#include <vector>

#include "camera/camera.h"
#include "render/frame.h"
#include "render/lens/lens_map.h"
#include "render/people/person_geometry.h"
#include "render/renderer.h"

namespace throng::render {

/// Renders with cameras of any lens. Colors are interpolated; ids, depth, normals, parts and flow
/// are those of the nearest pixel of the wide image, depth stays the camera's z, flow is that of
/// the distorted image. Boxes are those of the skinned vertices
/// projected through the lens, areas count the image's pixels; both as if the image went on around
/// itself for a quarter of its size. Pinholes are rendered as they are. The renderer and the
/// population, which is the renderer's, must outlive it.
class Lens {
 public:
  Lens(Renderer& renderer, const skinning::Population& population);
  ~Lens();
  Lens(const Lens&) = delete;
  Lens& operator=(const Lens&) = delete;

  /// `next` serves the flow only.
  Frame draw(const Scene& scene, const camera::Camera& camera, const NeighborFrame* next = nullptr);

  /// Only these rows: the frame's buffers hold them alone, while its camera and its people's boxes
  /// are those of the whole image, the latter over what is in these rows. Of the
  /// choice, `weights` are the lens's own.
  Frame draw_rows(const Scene& scene, const camera::Camera& camera, const Rows& rows,
                  const NeighborFrame* next = nullptr, const DrawChoice& choice = {});

  /// Takes the buffers of a frame that is not needed any more for one to come.
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
