#include "places/scenarios/plan/plan_drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "spec/layouts/plan_sheet.h"

namespace throng::scenarios {

using drawing::Color;
using drawing::Shape;
using Eigen::Vector2d;

namespace {

constexpr double kLettersPx = 13;

struct Entry {
  const char* words;
  Color color;
};

constexpr std::array<Entry, layouts::kLegendEntries> kLegend = {
    {{"building", colors::kBuilding},
     {"crowd obstacle", colors::kObstacle},
     {"prop", colors::kProp},
     {"open exit", colors::kOpenExit},
     {"closed exit", colors::kClosedExit},
     {"goal", colors::kGoal},
     {"initial position", colors::kPerson},
     {"people enter here", colors::kSource},
     {"drone", colors::kDrone},
     {"hazard", colors::kDanger}}};

/// The height of the scale and the legend below it, in a drawing of this width.
int legend_height_px(int width_px) {
  const int columns = (width_px - layouts::kPlanBorderPx) / layouts::kLegendColumnPx;
  const int rows = (static_cast<int>(kLegend.size()) + columns - 1) / columns;
  return (rows + 1) * layouts::kLegendLinePx;
}

/// A length for the scale: 1, 2 or 5 times a power of ten, about this long.
double round_length(double length_m) {
  const double power = std::pow(10, std::floor(std::log10(length_m)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= length_m) return digit * power;
  }
  return power;
}

Shape text_shape(const Vector2d& at_px, std::string text, double size_px, const Color& color) {
  Shape shape;
  shape.kind = Shape::Kind::text;
  shape.points = {at_px};
  shape.fill = color;
  shape.font_px = size_px;
  shape.outlined = true;
  shape.text = std::move(text);
  return shape;
}

}  // namespace

Sheet::Sheet(const world::Rectangle& area, int size_px) : area_(area) {
  const Vector2d size = area.max - area.min;
  px_per_m_ = size_px / size.maxCoeff();
  plan_height_px_ = static_cast<int>(std::ceil(size.y() * px_per_m_));
  drawing_.width_px =
      std::max(layouts::kMinPlanWidthPx,
               static_cast<int>(std::ceil(size.x() * px_per_m_)) + 2 * layouts::kPlanBorderPx);
  drawing_.height_px = layouts::kPlanTitlePx + plan_height_px_ + 2 * layouts::kPlanBorderPx +
                       legend_height_px(drawing_.width_px);
}

Vector2d Sheet::at(const Vector2d& point) const {
  return {layouts::kPlanBorderPx + (point.x() - area_.min.x()) * px_per_m_,
          layouts::kPlanTitlePx + layouts::kPlanBorderPx + plan_height_px_ -
              (point.y() - area_.min.y()) * px_per_m_};
}

void Sheet::polygon(std::span<const Vector2d> corners, const Color& fill, const Color& stroke,
                    double width_px) {
  Shape shape;
  for (const Vector2d& corner : corners) shape.points.push_back(at(corner));
  shape.fill = fill;
  shape.stroke = stroke;
  shape.width_px = width_px;
  drawing_.shapes.push_back(std::move(shape));
}

void Sheet::line(std::span<const Vector2d> points, const Color& stroke, double width_px,
                 bool arrow) {
  Shape shape;
  shape.kind = Shape::Kind::line;
  for (const Vector2d& point : points) shape.points.push_back(at(point));
  shape.stroke = stroke;
  shape.width_px = width_px;
  shape.arrow = arrow;
  drawing_.shapes.push_back(std::move(shape));
}

void Sheet::dot(const Vector2d& point, double radius_px, const Color& fill) {
  Shape shape;
  shape.kind = Shape::Kind::circle;
  shape.points = {at(point)};
  shape.fill = fill;
  shape.radius_px = radius_px;
  drawing_.shapes.push_back(std::move(shape));
}

void Sheet::ring(const Vector2d& point, double radius_m, const Color& stroke) {
  Shape shape;
  shape.kind = Shape::Kind::circle;
  shape.points = {at(point)};
  shape.stroke = stroke;
  shape.radius_px = std::max(2.0, radius_m * px_per_m_);
  drawing_.shapes.push_back(std::move(shape));
}

void Sheet::label(const Vector2d& point, const Vector2d& offset_px, const std::string& text,
                  const Color& color) {
  drawing_.shapes.push_back(text_shape(at(point) + offset_px, text, kLettersPx, color));
}

void Sheet::finish(const std::string& title) {
  constexpr double kTitleLettersPx = 18;
  drawing_.title = title;
  drawing_.shapes.push_back(text_shape({layouts::kPlanBorderPx, layouts::kPlanTitlePx}, title,
                                       kTitleLettersPx, colors::kInk));
  constexpr double kArrowPx = 34;
  const double right = drawing_.width_px - 2 * layouts::kPlanBorderPx;
  Shape north;
  north.kind = Shape::Kind::line;
  north.points = {Vector2d(right, layouts::kPlanTitlePx + kArrowPx),
                  Vector2d(right, layouts::kPlanTitlePx)};
  north.stroke = colors::kInk;
  north.width_px = 2;
  north.arrow = true;
  drawing_.shapes.push_back(std::move(north));
  drawing_.shapes.push_back(text_shape({right - 18, layouts::kPlanTitlePx + 14},
                                       std::string(1, 'N'), kLettersPx, colors::kInk));
  add_legend(layouts::kPlanTitlePx + plan_height_px_ + 2 * layouts::kPlanBorderPx);
}

void Sheet::add_legend(double top_px) {
  constexpr double kBarPx = 160;
  const double length_m = round_length(kBarPx / px_per_m_);
  Shape bar;
  bar.kind = Shape::Kind::line;
  const double end = layouts::kPlanBorderPx + length_m * px_per_m_;
  bar.points = {Vector2d(layouts::kPlanBorderPx, top_px),
                Vector2d(layouts::kPlanBorderPx, top_px + 6), Vector2d(end, top_px + 6),
                Vector2d(end, top_px)};
  bar.stroke = colors::kInk;
  bar.width_px = 2;
  drawing_.shapes.push_back(std::move(bar));
  const auto write = [&](const Vector2d& point, const std::string& text) {
    drawing_.shapes.push_back(text_shape(point, text, kLettersPx, colors::kInk));
  };
  write({end + 8, top_px + 8}, fmt::format("{:g} m", length_m));
  Vector2d point(layouts::kPlanBorderPx, top_px + layouts::kLegendLinePx + 6);
  for (const Entry& entry : kLegend) {
    if (point.x() + layouts::kLegendColumnPx > drawing_.width_px) {
      point = {static_cast<double>(layouts::kPlanBorderPx), point.y() + layouts::kLegendLinePx};
    }
    Shape box;
    box.points = {point, point + Vector2d(12, 0), point + Vector2d(12, 10),
                  point + Vector2d(0, 10)};
    box.fill = entry.color;
    box.fill.opacity = 1;
    drawing_.shapes.push_back(std::move(box));
    write(point + Vector2d(18, 10), entry.words);
    point.x() += layouts::kLegendColumnPx;
  }
}

}  // namespace throng::scenarios
