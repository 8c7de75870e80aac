#include "calibrate/residual_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrate/warnings.h"

namespace throng::calibrate {

namespace {

constexpr double kImageWidth = 800;  ///< of the drawn image, in units of the image
constexpr double kSide = 320;        ///< of the scatter
constexpr double kGap = 40;
constexpr double kTop = 60;
constexpr double kResidualTimes = 50;
constexpr double kBarHeight = 14;

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else {
      safe += c;
    }
  }
  return safe;
}

/// A color per view, around the circle of hues.
std::string color_of(std::size_t view, std::size_t views) {
  constexpr double kCircle = 360;
  return fmt::format("hsl({:.0f},65%,42%)",
                     kCircle * static_cast<double>(view) / static_cast<double>(views));
}

std::string text_at(double x, double y, const std::string& text, int size = 13) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\">{}</text>\n", x, y, size,
                     escaped(text));
}

std::string line(double x1, double y1, double x2, double y2, const std::string& color) {
  return fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\"/>\n", x1, y1, x2,
      y2, color);
}

template <typename Action>
void each_point(const Calibration& calibration, const Action& action) {
  for (std::size_t v = 0; v < calibration.views.size(); ++v) {
    for (const PointResult& point : calibration.views[v].points) action(v, point);
  }
}

/// The image with its points and residuals; cells without points are shaded.
std::string image_panel(const Calibration& calibration) {
  const double scale = kImageWidth / calibration.size.width;
  const double height = scale * calibration.size.height;
  std::string svg = fmt::format(
      "<g transform=\"translate({},{})\"><rect width=\"{:.1f}\" height=\"{:.1f}\" fill=\"white\" "
      "stroke=\"#888\"/>\n",
      kGap, kTop, kImageWidth, height);
  const Coverage covered = covered_cells(calibration);
  constexpr double kCellWidth = kImageWidth / kCoverageColumns;
  const double cell_height = height / kCoverageRows;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (covered.at(i)) continue;
    const std::size_t row = i / kCoverageColumns;
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#eee\"/>\n",
        kCellWidth * static_cast<double>(i % kCoverageColumns),
        cell_height * static_cast<double>(row), kCellWidth, cell_height);
  }
  each_point(calibration, [&](std::size_t view, const PointResult& point) {
    const std::string color =
        point.used ? color_of(view, calibration.views.size()) : std::string("red");
    const double x = scale * (point.pixel.x() + 0.5);
    const double y = scale * (point.pixel.y() + 0.5);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y,
                       point.used ? 1.5 : 5.0, color);
    if (!point.used || !point.residual.allFinite()) return;
    svg += line(x, y, x + scale * kResidualTimes * point.residual.x(),
                y + scale * kResidualTimes * point.residual.y(), color);
  });
  return svg + "</g>\n";
}

/// All residuals around 0.
std::string scatter_panel(const Calibration& calibration, double x) {
  double reach = 0;
  each_point(calibration, [&](std::size_t, const PointResult& point) {
    if (point.used) reach = std::max(reach, point.residual.cwiseAbs().maxCoeff());
  });
  reach = std::max(reach, 1e-9);
  const double half = 0.5 * kSide;
  std::string svg = fmt::format(
      "<g transform=\"translate({},{})\"><rect width=\"{}\" height=\"{}\" fill=\"white\" "
      "stroke=\"#888\"/>\n",
      x, kTop, kSide, kSide);
  svg += line(half, 0, half, kSide, "#ccc") + line(0, half, kSide, half, "#ccc");
  svg +=
      fmt::format("<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" fill=\"none\" stroke=\"#888\"/>\n",
                  half, half * calibration.rms_px / reach);
  each_point(calibration, [&](std::size_t view, const PointResult& point) {
    if (!point.used) return;
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.5\" fill=\"{}\"/>\n",
                       half + half * point.residual.x() / reach,
                       half + half * point.residual.y() / reach,
                       color_of(view, calibration.views.size()));
  });
  svg += text_at(4, kSide - 6, fmt::format("residuals up to {:.2f} px; circle: RMS", reach));
  return svg + "</g>\n";
}

std::string bars_panel(const Calibration& calibration, double x, double y) {
  double max_value = calibration.rms_px;
  for (const ViewResult& view : calibration.views) max_value = std::max(max_value, view.rms_px);
  max_value = std::max(max_value, 1e-9);
  constexpr double kLabel = 110;
  constexpr std::size_t kMaxNameLength = 18;
  std::string svg = fmt::format("<g transform=\"translate({},{})\">\n", x, y);
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    const ViewResult& view = calibration.views[i];
    const double at = kBarHeight * static_cast<double>(i);
    std::string name = view.name.substr(view.name.find_last_of('/') + 1);
    if (name.size() > kMaxNameLength) name = name.substr(0, kMaxNameLength);
    svg += text_at(0, at + kBarHeight - 4, name, 10);
    svg += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/>\n",
                       kLabel, at + 2, (kSide - kLabel - kGap) * view.rms_px / max_value,
                       kBarHeight - 4, color_of(i, calibration.views.size()));
    svg += text_at(kSide - kGap + 4, at + kBarHeight - 4, fmt::format("{:.3f}", view.rms_px), 10);
  }
  return svg + "</g>\n";
}

}  // namespace

std::string residual_plot(const Calibration& calibration) {
  const double left = kGap + kImageWidth + kGap;
  const double bars = kTop + kSide + kGap;
  const double width = left + kSide + kGap;
  const double image = kImageWidth * calibration.size.height / calibration.size.width;
  const double height =
      kGap +
      std::max(kTop + image, bars + kBarHeight * static_cast<double>(calibration.views.size()));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 "
      "0 "
      "{0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fafafa\"/>\n",
      width, height);
  svg += text_at(kGap, 36,
                 fmt::format("{}: {} views, {} points, {} outliers; RMS {:.4f} px; points in "
                             "{:.0f} % of the image (gray: none); residuals x {:.0f}",
                             calibration.kind, calibration.views.size(), calibration.points,
                             calibration.rejected, calibration.rms_px,
                             100 * coverage_of(calibration), kResidualTimes),
                 15);
  return svg + image_panel(calibration) + scatter_panel(calibration, left) +
         bars_panel(calibration, left, bars) + "</svg>\n";
}

}  // namespace throng::calibrate
