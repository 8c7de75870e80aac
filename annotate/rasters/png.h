// Ground truth per pixel as lossless PNG files; what their values mean is in docs/formats.md. ISA-L
// compresses several times faster than zlib, at nearly the same size.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "render/frame.h"

namespace throng::annotate {

/// Samples of an image, row by row from the top, channels interleaved.
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 1;  ///< 1 (gray) or 3 (RGB)
};

/// The bytes of a PNG file. Checks that there are width * height * channels samples.
std::string png_bytes(const Raster& raster, std::span<const std::uint8_t> samples);
std::string png_bytes(const Raster& raster, std::span<const std::uint16_t> samples);

/// Depth in depth_png() of one meter.
inline constexpr float kDepthPerMeter = 100;

/// 16-bit gray: camera z in centimeters, rounded; 0 for the sky and whatever is farther than
/// 655.35 m.
std::string depth_png(const render::Frame& frame);

/// 8-bit RGB: red + 256 * green + 65536 * blue is the instance: 0 sky, agent + 1 for a person, and
/// for static objects the id buffer's highest byte << 16 with its lowest 16 bits.
std::string instance_png(const render::Frame& frame);

/// 8-bit gray: a world::SemanticClass for each pixel (docs/formats_pixels.md#semantic). Checks that
/// the frame has them.
std::string semantic_png(const render::Frame& frame);

/// 8-bit gray: render::BodyPart. Checks that the frame has parts.
std::string part_png(const render::Frame& frame);

/// 8-bit RGB: Frame::normal as it is. Checks that the frame has normals.
std::string normal_png(const render::Frame& frame);

/// 16-bit RGB in KITTI's format: 32768 + 64 * motion, rounded, right and down; blue 1, or all 0
/// where the flow is unknown or leaves the format's range of +-512 pixels. Checks that the frame
/// has flow.
std::string flow_png(const render::Frame& frame);

/// The same of Frame::flow_backward.
std::string flow_backward_png(const render::Frame& frame);

/// 8-bit gray: render::FlowTarget. Checks that the frame has them.
std::string flow_occlusion_png(const render::Frame& frame);

/// 8-bit RGB: Frame::hazard_opacity as it is. Checks that the frame has it.
std::string hazard_opacity_png(const render::Frame& frame);

/// 16-bit RGB: 32768 + 1000 * motion in the world (m), rounded; all 0 where it is unknown or
/// farther than 32.7 m. Checks that the frame has it.
std::string scene_flow_png(const render::Frame& frame);

}  // namespace throng::annotate
