// Ground truth per pixel as lossless PNG files; docs/formats.md defines their values. Compressed by
// ISA-L, which is several times faster than zlib at nearly the same size.
// Functions of a frame fail a check() if it lacks their buffer.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "render/frame/frame.h"

namespace throng::annotate {

/// Shape of an image whose samples are stored row by row from the top, with interleaved channels.
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 1;  ///< 1 (gray) or 3 (RGB)
};

/// The bytes of a PNG file. Fails a check() unless there are width * height * channels samples.
std::string png_bytes(const Raster& raster, std::span<const std::uint8_t> samples);
std::string png_bytes(const Raster& raster, std::span<const std::uint16_t> samples);

/// Scale of depth_png(): values per meter.
inline constexpr float kDepthPerMeter = 100;

/// 16-bit gray: z in the camera frame in centimeters, rounded; 0 for the sky and beyond 655.35 m.
std::string depth_png(const render::Frame& frame);

/// 8-bit RGB: the instance is red + 256 * green + 65536 * blue: 0 for the sky, agent id + 1 for a
/// person; for a static object, the highest byte of its id in the buffer << 16 plus its lowest 16
/// bits.
std::string instance_png(const render::Frame& frame);

/// 8-bit gray: world::SemanticClass (docs/formats_pixels.md#semantic).
std::string semantic_png(const render::Frame& frame);

/// 8-bit gray: render::BodyPart.
std::string part_png(const render::Frame& frame);

/// 8-bit RGB: the bytes of Frame::normal.
std::string normal_png(const render::Frame& frame);

/// Optical flow as 16-bit RGB in KITTI's format: red and green are 32768 + 64 * motion to the right
/// and down in pixels, rounded, and blue is 1; all are 0 if the flow is unknown or outside of the
/// format's range of +-512 pixels.
std::string flow_png(const render::Frame& frame);

/// Frame::flow_backward in the same format.
std::string flow_backward_png(const render::Frame& frame);

/// 8-bit gray: render::FlowTarget.
std::string flow_occlusion_png(const render::Frame& frame);

/// 8-bit RGB: the bytes of Frame::hazard_opacity.
std::string hazard_opacity_png(const render::Frame& frame);

/// Scene flow as 16-bit RGB: 32768 + 1000 * motion in world coordinates (m), rounded; all 0 if the
/// motion is unknown or exceeds 32.7 m.
std::string scene_flow_png(const render::Frame& frame);

}  // namespace throng::annotate
