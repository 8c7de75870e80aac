// A drawing as SVG, and as PNG with OpenCV.
#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/files.h"
#include "places/plan.h"

namespace throng::places {

using Eigen::Vector2d;

namespace {

constexpr double kHeadPx = 10;  // of an arrow
constexpr double kRimPx = 3;    // of letters

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string color(const Ink& ink) {
  return fmt::format("#{:02x}{:02x}{:02x}", ink.rgb[0], ink.rgb[1], ink.rgb[2]);
}

std::string paint(const Mark& mark) {
  std::string words = mark.fill.opacity > 0 ? fmt::format("fill=\"{}\"", color(mark.fill))
                                            : std::string("fill=\"none\"");
  if (mark.fill.opacity > 0 && mark.fill.opacity < 1) {
    words += fmt::format(" fill-opacity=\"{:.2g}\"", mark.fill.opacity);
  }
  if (mark.stroke.opacity > 0) {
    words += fmt::format(" stroke=\"{}\"", color(mark.stroke));
    if (mark.stroke.opacity < 1) {
      words += fmt::format(" stroke-opacity=\"{:.2g}\"", mark.stroke.opacity);
    }
    if (mark.kind != Mark::Kind::circle) {
      words += fmt::format(" stroke-width=\"{:.4g}\"", mark.width_px);
    }
  }
  return words;
}

/// The three corners of an arrow's head.
std::vector<Vector2d> head_of(const Mark& line) {
  const Vector2d tip = line.points.back();
  const Vector2d before = line.points[line.points.size() - 2];
  const Vector2d along = (tip - before).normalized();
  const Vector2d across(-along.y(), along.x());
  const double size = kHeadPx + line.width_px;
  return {tip, tip - size * along + 0.5 * size * across, tip - size * along - 0.5 * size * across};
}

std::string points_text(const std::vector<Vector2d>& points) {
  std::string words;
  for (const Vector2d& point : points) {
    words += fmt::format("{}{:.1f},{:.1f}", words.empty() ? "" : " ", point.x(), point.y());
  }
  return words;
}

std::string element_of(const Mark& mark) {
  switch (mark.kind) {
    case Mark::Kind::polygon:
      return fmt::format("<polygon points=\"{}\" {}/>\n", points_text(mark.points), paint(mark));
    case Mark::Kind::line: {
      std::string words =
          fmt::format("<polyline points=\"{}\" {}/>\n", points_text(mark.points), paint(mark));
      if (mark.arrow) {
        words += fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"{:.2g}\"/>\n",
                             points_text(head_of(mark)), color(mark.stroke), mark.stroke.opacity);
      }
      return words;
    }
    case Mark::Kind::circle:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.4g}\" {}/>\n",
                         mark.points.front().x(), mark.points.front().y(), mark.width_px,
                         paint(mark));
    case Mark::Kind::text:
      break;
  }
  // With a rim, since what it stands on has many colors.
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.3g}\" fill=\"{}\" stroke=\"#ffffff\" "
      "stroke-width=\"{:.2g}\" stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>\n",
      mark.points.front().x(), mark.points.front().y(), mark.width_px, color(mark.fill), kRimPx,
      escaped(mark.text));
}

/// Draws with OpenCV, several times as large, and makes it smaller in the end.
class Canvas {
 public:
  explicit Canvas(const Drawing& drawing)
      : picture_(kFiner * drawing.height_px, kFiner * drawing.width_px, CV_8UC3,
                 cv::Scalar(255, 255, 255)) {}

  void draw(const Mark& mark) {
    const std::vector<cv::Point> points = pixels_of(mark.points);
    if (mark.kind == Mark::Kind::text) {
      write(mark, points.front());
    } else if (mark.kind == Mark::Kind::circle) {
      const int radius = std::max(1, static_cast<int>(std::lround(kFiner * mark.width_px)));
      over(mark.fill, [&](cv::Mat& on, const cv::Scalar& ink) {
        cv::circle(on, points.front(), radius, ink, cv::FILLED);
      });
      over(mark.stroke, [&](cv::Mat& on, const cv::Scalar& ink) {
        cv::circle(on, points.front(), radius, ink, kFiner);
      });
    } else {
      const int width = std::max(1, static_cast<int>(std::lround(kFiner * mark.width_px)));
      over(mark.fill, [&](cv::Mat& on, const cv::Scalar& ink) {
        cv::fillPoly(on, std::vector<std::vector<cv::Point>>{points}, ink);
      });
      over(mark.stroke, [&](cv::Mat& on, const cv::Scalar& ink) {
        cv::polylines(on, points, mark.kind == Mark::Kind::polygon, ink, width);
        if (!mark.arrow) return;
        cv::fillPoly(on, std::vector<std::vector<cv::Point>>{pixels_of(head_of(mark))}, ink);
      });
    }
  }

  cv::Mat take() {
    cv::Mat small;
    cv::resize(picture_, small, picture_.size() / kFiner, 0, 0, cv::INTER_AREA);
    return small;
  }

 private:
  static constexpr int kFiner = 2;

  static std::vector<cv::Point> pixels_of(const std::vector<Vector2d>& points) {
    std::vector<cv::Point> pixels;
    pixels.reserve(points.size());
    for (const Vector2d& point : points) {
      pixels.emplace_back(static_cast<int>(std::lround(kFiner * point.x())),
                          static_cast<int>(std::lround(kFiner * point.y())));
    }
    return pixels;
  }

  template <typename Paint>
  void over(const Ink& ink, const Paint& paint_on) {
    if (ink.opacity <= 0) return;
    const cv::Scalar rgb(ink.rgb[0], ink.rgb[1], ink.rgb[2]);
    if (ink.opacity >= 1) return paint_on(picture_, rgb);
    cv::Mat painted = picture_.clone();
    paint_on(painted, rgb);
    cv::addWeighted(painted, ink.opacity, picture_, 1 - ink.opacity, 0, picture_);
  }

  void write(const Mark& mark, const cv::Point& at) {
    constexpr double kCapitalsPx = 28;  // of the font at scale 1, as tall as SVG's letters
    const cv::Scalar rgb(mark.fill.rgb[0], mark.fill.rgb[1], mark.fill.rgb[2]);
    const auto put = [&](const cv::Scalar& ink, double width_px) {
      cv::putText(picture_, mark.text, at, cv::FONT_HERSHEY_SIMPLEX,
                  kFiner * mark.width_px / kCapitalsPx, ink,
                  static_cast<int>(std::lround(kFiner * width_px)), cv::LINE_AA);
    };
    put(cv::Scalar(255, 255, 255), 1 + kRimPx);
    put(rgb, 1);
  }

  cv::Mat picture_;  // RGB
};

}  // namespace

std::string to_svg(const Drawing& drawing) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      drawing.width_px, drawing.height_px);
  for (const Mark& mark : drawing.marks) text += element_of(mark);
  return text + "</svg>\n";
}

std::string to_png(const Drawing& drawing) {
  Canvas canvas(drawing);
  for (const Mark& mark : drawing.marks) canvas.draw(mark);
  const cv::Mat picture = canvas.take();
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.cols);
  image.height = static_cast<png_uint_32>(picture.rows);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  const int done =
      png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.data, 0, nullptr);
  throng::check(done != 0, "a picture in memory becomes a PNG file");
  bytes.resize(size);
  return bytes;
}

void write_plan(const Drawing& drawing, const std::filesystem::path& file) {
  const std::string suffix = file.extension().string();
  if (suffix != ".svg" && suffix != ".png") {
    throw InputError({file.string(), "", fmt::format("the suffix \"{}\"", suffix),
                      "a file name that ends with .svg or .png"});
  }
  write_file_atomically(file, suffix == ".svg" ? to_svg(drawing) : to_png(drawing));
}

}  // namespace throng::places
