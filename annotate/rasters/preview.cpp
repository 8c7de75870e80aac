#include "annotate/rasters/preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"

namespace throng::annotate {

namespace {

// Neighboring ids get hues far apart: steps of the golden ratio never come close to each other.
cv::Scalar agent_color(std::uint32_t agent) {
  const double hue = 6 * std::fmod(agent * 0.6180339887498949, 1.0);
  const auto channel = [hue](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return 255 * (1 - 0.85 * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

void draw_caption(cv::Mat& image, const std::string& caption) {
  const double scale = std::max(0.4, image.rows / 1200.0);
  const int thickness = std::max(1, static_cast<int>(std::lround(scale * 1.5)));
  int baseline = 0;
  const cv::Size text =
      cv::getTextSize(caption, cv::FONT_HERSHEY_SIMPLEX, scale, thickness, &baseline);
  const int margin = text.height / 2;
  const cv::Rect strip =
      cv::Rect(0, 0, text.width + 2 * margin, text.height + baseline + 2 * margin) &
      cv::Rect(0, 0, image.cols, image.rows);
  image(strip) *= 0.35;
  cv::putText(image, caption, {margin, margin + text.height}, cv::FONT_HERSHEY_SIMPLEX, scale,
              {255, 255, 255}, thickness, cv::LINE_AA);
}

}  // namespace

std::vector<std::uint8_t> draw_preview(const render::Frame& frame, const FrameLabels& labels) {
  const std::size_t bytes = 3U * static_cast<std::size_t>(frame.width()) * frame.height();
  check(frame.rgb.size() == bytes, "the image has the camera's size");
  std::vector<std::uint8_t> rgb = frame.rgb;
  cv::Mat image(frame.height(), frame.width(), CV_8UC3, rgb.data());
  for (const PersonLabel& person : labels.people) {
    const PixelBox& box = person.box;
    cv::rectangle(image, cv::Rect(box.x, box.y, box.width, box.height), agent_color(person.agent));
  }
  draw_caption(image, fmt::format("t = {:.1f} s   {} of {} people visible", labels.time_s,
                                  labels.people.size(), frame.people.size()));
  return rgb;
}

}  // namespace throng::annotate
