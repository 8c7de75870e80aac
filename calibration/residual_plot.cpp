#include "calibration/residual_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibration/warnings.h"

namespace throng::calibrate {

using drawing::Color;
using drawing::Drawing;
using drawing::Shape;
using Eigen::Vector2d;

namespace {

constexpr double kImageWidth = 800;  ///< of the drawn image, in units of the image
constexpr double kSide = 320;        ///< of the scatter
constexpr double kGap = 40;
constexpr double kTop = 60;
constexpr double kResidualScale = 50;
constexpr double kBarHeight = 14;
constexpr double kTextPx = 13;
constexpr double kDotPx = 1.5;

constexpr Color kInk{{0, 0, 0}};
constexpr Color kWhite{{255, 255, 255}};
constexpr Color kBackground{{250, 250, 250}};
constexpr Color kUncovered{{238, 238, 238}};
constexpr Color kFrame{{136, 136, 136}};
constexpr Color kAxis{{204, 204, 204}};
constexpr Color kOutlier{{255, 0, 0}};

/// A color per view, around the circle of hues.
Color view_color(std::size_t view, std::size_t views) {
  constexpr double kCircleDeg = 360;
  return drawing::from_hsl(kCircleDeg * static_cast<double>(view) / static_cast<double>(views),
                           0.65, 0.42);
}

/// A part of the drawing with an origin of its own.
class Panel {
 public:
  Panel(Drawing& drawing, const Vector2d& origin) : drawing_(drawing), origin_(origin) {}

  void text(const Vector2d& at, std::string words, double font_px = kTextPx) {
    Shape& shape = add(Shape::Kind::text, {at});
    shape.fill = kInk;
    shape.text = std::move(words);
    shape.font_px = font_px;
  }
  void line(const Vector2d& from, const Vector2d& to, const Color& color) {
    add(Shape::Kind::line, {from, to}).stroke = color;
  }
  void rectangle(const Vector2d& min, const Vector2d& size, const Color& fill,
                 const Color& stroke = drawing::kTransparent) {
    const Vector2d max = min + size;
    Shape& shape = add(Shape::Kind::polygon, {min, {max.x(), min.y()}, max, {min.x(), max.y()}});
    shape.fill = fill;
    shape.stroke = stroke;
  }
  void circle(const Vector2d& center, double radius_px, const Color& fill,
              const Color& stroke = drawing::kTransparent) {
    Shape& shape = add(Shape::Kind::circle, {center});
    shape.radius_px = radius_px;
    shape.fill = fill;
    shape.stroke = stroke;
  }

 private:
  Shape& add(Shape::Kind kind, std::vector<Vector2d> points) {
    for (Vector2d& point : points) point += origin_;
    Shape& shape = drawing_.shapes.emplace_back();
    shape.kind = kind;
    shape.points = std::move(points);
    return shape;
  }

  Drawing& drawing_;
  Vector2d origin_;
};

template <typename Action>
void each_point(const Calibration& calibration, const Action& action) {
  for (std::size_t v = 0; v < calibration.views.size(); ++v) {
    for (const PointResult& point : calibration.views[v].points) action(v, point);
  }
}

/// The image with its points and residuals; cells without points are shaded.
void draw_image(const Calibration& calibration, Panel panel) {
  const double scale = kImageWidth / calibration.size.width;
  const double height = scale * calibration.size.height;
  panel.rectangle({0, 0}, {kImageWidth, height}, kWhite, kFrame);
  const Coverage covered = covered_cells(calibration);
  const Vector2d cell(kImageWidth / kCoverageColumns, height / kCoverageRows);
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (covered.at(i)) continue;
    const std::size_t row = i / kCoverageColumns;
    const Vector2d place(static_cast<double>(i % kCoverageColumns), static_cast<double>(row));
    panel.rectangle(place.cwiseProduct(cell), cell, kUncovered);
  }
  constexpr double kOutlierPx = 5;
  each_point(calibration, [&](std::size_t view, const PointResult& point) {
    const Color color = point.used ? view_color(view, calibration.views.size()) : kOutlier;
    const Vector2d at = scale * (point.pixel + Vector2d(0.5, 0.5));
    panel.circle(at, point.used ? kDotPx : kOutlierPx, color);
    if (!point.used || !point.residual.allFinite()) return;
    panel.line(at, at + scale * kResidualScale * point.residual, color);
  });
}

/// All residuals around 0.
void draw_scatter(const Calibration& calibration, Panel panel) {
  double reach_px = 1e-9;
  each_point(calibration, [&](std::size_t, const PointResult& point) {
    if (point.used) reach_px = std::max(reach_px, point.residual.cwiseAbs().maxCoeff());
  });
  constexpr double kHalf = 0.5 * kSide;
  const Vector2d center(kHalf, kHalf);
  panel.rectangle({0, 0}, {kSide, kSide}, kWhite, kFrame);
  panel.line({kHalf, 0}, {kHalf, kSide}, kAxis);
  panel.line({0, kHalf}, {kSide, kHalf}, kAxis);
  panel.circle(center, kHalf * calibration.rms_px / reach_px, drawing::kTransparent, kFrame);
  each_point(calibration, [&](std::size_t view, const PointResult& point) {
    if (!point.used) return;
    panel.circle(center + kHalf / reach_px * point.residual, kDotPx,
                 view_color(view, calibration.views.size()));
  });
  panel.text({4, kSide - 6}, fmt::format("residuals up to {:.2f} px; circle: RMS", reach_px));
}

/// The RMS error of each view.
void draw_bars(const Calibration& calibration, Panel panel) {
  double max_px = std::max(calibration.rms_px, 1e-9);
  for (const ViewResult& view : calibration.views) max_px = std::max(max_px, view.rms_px);
  constexpr double kLabelPx = 110;
  constexpr double kSmallTextPx = 10;
  constexpr std::size_t kMaxNameLength = 18;
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    const ViewResult& view = calibration.views[i];
    const double y = kBarHeight * static_cast<double>(i);
    const std::string name = view.name.substr(view.name.find_last_of('/') + 1);
    panel.text({0, y + kBarHeight - 4}, name.substr(0, kMaxNameLength), kSmallTextPx);
    panel.rectangle({kLabelPx, y + 2},
                    {(kSide - kLabelPx - kGap) * view.rms_px / max_px, kBarHeight - 4},
                    view_color(i, calibration.views.size()));
    panel.text({kSide - kGap + 4, y + kBarHeight - 4}, fmt::format("{:.3f}", view.rms_px),
               kSmallTextPx);
  }
}

}  // namespace

Drawing residual_plot(const Calibration& calibration) {
  constexpr double kLeft = kGap + kImageWidth + kGap;
  constexpr double kBarsTop = kTop + kSide + kGap;
  const double image = kImageWidth * calibration.size.height / calibration.size.width;
  const double bars = kBarHeight * static_cast<double>(calibration.views.size());
  Drawing drawing;
  drawing.width_px = static_cast<int>(kLeft + kSide + kGap);
  drawing.height_px = static_cast<int>(std::ceil(kGap + std::max(kTop + image, kBarsTop + bars)));
  drawing.title = "Calibration residuals";
  Panel page(drawing, {0, 0});
  page.rectangle({0, 0}, {drawing.width_px, drawing.height_px}, kBackground);
  constexpr double kTitlePx = 15;
  page.text({kGap, 36},
            fmt::format("{}: {} views, {} points, {} outliers; RMS {:.4f} px; points in {:.0f} % "
                        "of the image (gray: none); residuals x {:.0f}",
                        calibration.kind, calibration.views.size(), calibration.points,
                        calibration.rejected, calibration.rms_px, 100 * image_coverage(calibration),
                        kResidualScale),
            kTitlePx);
  draw_image(calibration, Panel(drawing, {kGap, kTop}));
  draw_scatter(calibration, Panel(drawing, {kLeft, kTop}));
  draw_bars(calibration, Panel(drawing, {kLeft, kBarsTop}));
  return drawing;
}

}  // namespace throng::calibrate
