#include "render/gl/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "render/frame/view.h"

namespace throng::render {

namespace {

int size_within_limits(int width, int height) {
  const int limit = max_target_px();
  if (std::min(width, height) < 1 || std::max(width, height) > limit) {
    throw EnvironmentError(
        fmt::format("cannot render an image of {} x {} pixels: this device supports up to {} x {}",
                    width, height, limit, limit));
  }
  return width;
}

/// Between sRGB values and light: images are averaged in the latter, as a lens does.
class LightTable {
 public:
  LightTable() {
    for (std::size_t i = 0; i < light_.size(); ++i) {
      light_[i] = static_cast<std::uint32_t>(
          std::lround(kMaxCode * std::pow(static_cast<double>(i) / 255, kGamma)));
    }
    for (std::size_t i = 0; i < value_.size(); ++i) {
      value_[i] = static_cast<std::uint8_t>(
          std::lround(255 * std::pow(static_cast<double>(i) / kMaxCode, 1 / kGamma)));
    }
  }
  std::uint32_t light(std::uint32_t value) const { return light_[value]; }
  std::uint8_t value(std::uint32_t light) const { return value_[light]; }

 private:
  static constexpr double kGamma = 2.2;
  static constexpr std::uint32_t kMaxCode = 4095;
  std::array<std::uint32_t, 256> light_{};
  std::array<std::uint8_t, kMaxCode + 1> value_{};
};

void copy_image(const Texture& from, const Texture& to, int width, int height) {
  glCopyImageSubData(from.name(), GL_TEXTURE_2D, 0, 0, 0, 0, to.name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                     width, height, 1);
}

}  // namespace

int max_target_px() {
  GLint texture = 0;
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return std::min({texture, viewport[0] - 2 * kGuardBand, viewport[1] - 2 * kGuardBand});
}

Target::Target(int width, int height)
    : width_(size_within_limits(width, height)),
      height_(height),
      color_(make_texture_2d(GL_RGBA8, width, height)),
      id_(make_texture_2d(GL_R32UI, width, height)),
      depth_(make_texture_2d(GL_DEPTH_COMPONENT32F, width, height)) {
  check_gl("making the image buffers");
  framebuffer_ = make_framebuffer({color_.name(), id_.name()}, depth_.name());
}

void Target::keep_depth() {
  if (!kept_depth_) kept_depth_ = make_texture_2d(GL_DEPTH_COMPONENT32F, width_, height_);
  copy_image(depth_, *kept_depth_, width_, height_);
}

void Target::restore_depth() const { copy_image(*kept_depth_, depth_, width_, height_); }

void Target::begin(const Eigen::Vector3f& sky) const {
  const GLuint name = framebuffer_.name();
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  const Viewport viewport = guarded_viewport(width_, height_);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  const std::array<float, 4> color = {sky.x(), sky.y(), sky.z(), 1.0F};
  const std::array<GLuint, 4> nothing = {kIdNothing, 0, 0, 0};
  const float infinitely_far = 0.0F;
  glClearNamedFramebufferfv(name, GL_COLOR, 0, color.data());
  glClearNamedFramebufferuiv(name, GL_COLOR, 1, nothing.data());
  glClearNamedFramebufferfv(name, GL_DEPTH, 0, &infinitely_far);
}

void Target::read(bool color, Frame& frame) {
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  frame.id.resize(pixels);
  frame.depth_m.resize(pixels);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  if (color) {
    rgba_.resize(pixels);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
    pack_rgb(rgba_, frame.rgb);
  }
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, frame.id.data());
  glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, frame.depth_m.data());
  // Depth is stored as kNear / z, 0 where nothing was rendered: that becomes infinity here.
  for (float& depth : frame.depth_m) depth = kNear / depth;
}

void Target::read_light(int samples, Frame& frame) {
  rgba_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  static const LightTable table;
  const int width = width_ / samples;
  const int height = height_ / samples;
  frame.rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  std::uint8_t* out = frame.rgb.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, out += 3) {
      std::array<std::uint32_t, 3> sum{};
      for (int j = 0; j < samples; ++j) {
        const std::uint32_t* row =
            &rgba_[static_cast<std::size_t>(y * samples + j) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x * samples)];
        for (int i = 0; i < samples; ++i) {
          for (std::size_t c = 0; c < 3; ++c) sum[c] += table.light((row[i] >> (8 * c)) & 0xFFU);
        }
      }
      const auto count = static_cast<std::uint32_t>(samples * samples);
      for (std::size_t c = 0; c < 3; ++c) out[c] = table.value(sum[c] / count);
    }
  }
}

void pack_rgb(const std::vector<std::uint32_t>& rgba, std::vector<std::uint8_t>& rgb) {
  // Four pixels at a time are three words.
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint32_t kColor = 0xFFFFFFU;
  rgb.resize(rgba.size() * 3);
  std::size_t i = 0;
  for (; i + 4 <= rgba.size(); i += 4) {
    const std::uint32_t a = rgba[i] & kColor;
    const std::uint32_t b = rgba[i + 1] & kColor;
    const std::uint32_t c = rgba[i + 2] & kColor;
    const std::uint32_t d = rgba[i + 3];
    const std::array<std::uint32_t, 3> words = {a | (b << 24U), (b >> 8U) | (c << 16U),
                                                (c >> 16U) | (d << 8U)};
    std::memcpy(&rgb[i * 3], words.data(), sizeof(words));
  }
  for (; i < rgba.size(); ++i) std::memcpy(&rgb[i * 3], &rgba[i], 3);
}

}  // namespace throng::render
