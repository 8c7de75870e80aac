#include "validation/experiments/plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/compute/quantile.h"

namespace throng::validation {

using drawing::Color;
using drawing::Drawing;
using drawing::Shape;
using Eigen::Vector2d;

namespace {

constexpr double kTextPx = 12;
constexpr double kLetterPx = 0.55 * kTextPx;  ///< mean width
constexpr double kLegendPx = 30;              ///< height
constexpr double kLeftPx = 46;                ///< margins of a panel
constexpr double kRightPx = 18;
constexpr double kTopPx = 26;
constexpr double kBottomPx = 40;

constexpr Color kInk{{0, 0, 0}};
constexpr Color kFrame{{136, 136, 136}};
constexpr Color kGrid{{230, 230, 230}};

Color model_color(std::size_t model, std::size_t models, double opacity = 1) {
  constexpr double kCircleDeg = 360;
  Color color = drawing::from_hsl(
      kCircleDeg * static_cast<double>(model) / static_cast<double>(models), 0.75, 0.45);
  color.opacity = opacity;
  return color;
}

void add_text(Drawing& drawing, const Vector2d& at, std::string words) {
  Shape& shape = drawing.shapes.emplace_back();
  shape.kind = Shape::Kind::text;
  shape.points = {at};
  shape.fill = kInk;
  shape.font_px = kTextPx;
  shape.text = std::move(words);
}

void add_line(Drawing& drawing, std::vector<Vector2d> points, const Color& color,
              double width_px = 1) {
  Shape& shape = drawing.shapes.emplace_back();
  shape.kind = Shape::Kind::line;
  shape.points = std::move(points);
  shape.stroke = color;
  shape.width_px = width_px;
}

void add_circle(Drawing& drawing, const Vector2d& center, const Color& color) {
  constexpr double kDotPx = 3.5;
  Shape& shape = drawing.shapes.emplace_back();
  shape.kind = Shape::Kind::circle;
  shape.points = {center};
  shape.radius_px = kDotPx;
  shape.fill = color;
}

/// A line for each model and for the recorded people.
void add_legend(Drawing& drawing, const Comparison& comparison) {
  constexpr double kSamplePx = 24;
  double x = kLeftPx;
  const auto entry = [&](const std::string& name, const Color& color) {
    const double y = 0.6 * kLegendPx;
    add_line(drawing, {{x, y}, {x + kSamplePx, y}}, color, 3);
    add_text(drawing, {x + kSamplePx + 5, y + 4}, name);
    x += kSamplePx + 20 + kLetterPx * static_cast<double>(name.size());
  };
  entry("recorded people", kInk);
  for (std::size_t model = 0; model < comparison.models.size(); ++model) {
    entry(comparison.models[model], model_color(model, comparison.models.size()));
  }
  drawing.width_px = std::max(drawing.width_px, static_cast<int>(std::ceil(x)));
}

/// A distance of ticks with some four of them up to `max`: 1, 2 or 5 times a power of ten.
double tick_step(double max) {
  constexpr double kTicks = 5;
  const double raw = max / kTicks;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

/// Axes from 0 to `max` in a rectangle of pixels.
class Axes {
 public:
  Axes(Drawing& drawing, const Vector2d& corner, const Vector2d& size, Vector2d max)
      : drawing_(drawing), corner_(corner), size_(size), max_(std::move(max)) {}

  Vector2d at(double x, double y) const {
    return {corner_.x() + size_.x() * x / max_.x(), corner_.y() + size_.y() * (1 - y / max_.y())};
  }
  const Vector2d& max() const { return max_; }

  void draw(const std::string& title, const std::string& x_label, const std::string& y_label) {
    const double step_x = tick_step(max_.x());
    for (double x = 0; x <= max_.x(); x += step_x) {
      add_line(drawing_, {at(x, 0), at(x, max_.y())}, kGrid);
      const std::string label = fmt::format("{:g}", x);
      const double half_px = 0.5 * kLetterPx * static_cast<double>(label.size());
      add_text(drawing_, at(x, 0) + Vector2d(-half_px, kTextPx + 3), label);
    }
    const double step_y = tick_step(max_.y());
    for (double y = 0; y <= max_.y(); y += step_y) {
      add_line(drawing_, {at(0, y), at(max_.x(), y)}, kGrid);
      const std::string label = fmt::format("{:g}", y);
      const double width_px = kLetterPx * static_cast<double>(label.size());
      add_text(drawing_, at(0, y) + Vector2d(-width_px - 5, 4), label);
    }
    add_line(drawing_, {at(0, max_.y()), at(0, 0), at(max_.x(), 0)}, kFrame);
    add_text(drawing_, at(0, max_.y()) + Vector2d(0, -8), title);
    const double label_px = kLetterPx * static_cast<double>(x_label.size());
    add_text(drawing_, at(max_.x(), 0) + Vector2d(-label_px, 2 * kTextPx + 6), x_label);
    add_text(drawing_, at(0, max_.y()) + Vector2d(5, kTextPx + 2), y_label);
  }

 private:
  Drawing& drawing_;
  Vector2d corner_;
  Vector2d size_;
  Vector2d max_;
};

/// When the first run, the median and the last have let n people pass, s, for n from 1 on; times
/// that a run does not reach are infinite.
struct Band {
  std::vector<double> first_s;
  std::vector<double> median_s;
  std::vector<double> last_s;
};

Band passages_band(const std::vector<std::vector<double>>& runs) {
  std::size_t most = 0;
  for (const std::vector<double>& run : runs) most = std::max(most, run.size());
  Band band;
  for (std::size_t n = 0; n < most; ++n) {
    std::vector<double> times_s;
    times_s.reserve(runs.size());
    for (const std::vector<double>& run : runs) {
      times_s.push_back(n < run.size() ? run[n] : std::numeric_limits<double>::infinity());
    }
    std::sort(times_s.begin(), times_s.end());
    band.first_s.push_back(times_s.front());
    band.median_s.push_back(quantile_of_sorted(times_s, 0.5));
    band.last_s.push_back(times_s.back());
  }
  return band;
}

/// The points of a curve; times are cut at the right end of the axes.
std::vector<Vector2d> curve_points(const Axes& axes, const std::vector<double>& times_s) {
  std::vector<Vector2d> points = {axes.at(0, 0)};
  for (std::size_t n = 0; n < times_s.size(); ++n) {
    if (n == 0) points.push_back(axes.at(std::min(times_s[0], axes.max().x()), 0));
    if (times_s[n] > axes.max().x()) break;
    points.push_back(axes.at(times_s[n], static_cast<double>(n + 1)));
  }
  return points;
}

void add_band(Drawing& drawing, const Axes& axes, const Band& band, const Color& color) {
  Shape& shape = drawing.shapes.emplace_back();
  shape.kind = Shape::Kind::polygon;
  shape.fill = color;
  for (const std::vector<double>* side : {&band.first_s, &band.last_s}) {
    std::vector<Vector2d> points;
    for (std::size_t n = 0; n < side->size(); ++n) {
      const double time_s = std::min((*side)[n], axes.max().x());
      points.push_back(axes.at(time_s, static_cast<double>(n + 1)));
    }
    if (side == &band.last_s) std::reverse(points.begin(), points.end());
    shape.points.insert(shape.points.end(), points.begin(), points.end());
  }
  if (shape.points.empty()) drawing.shapes.pop_back();
}

/// The end of the axis of time: that of the recording, and of models as far as half as much again.
double last_time_s(const ComparedExperiment& experiment) {
  constexpr double kMore = 1.5;
  double recorded_s = 0;
  double model_s = 1;
  if (!experiment.recorded_passages_s.empty()) recorded_s = experiment.recorded_passages_s.back();
  for (const auto& model : experiment.passages_s) {
    for (const std::vector<double>& run : model) {
      if (!run.empty()) model_s = std::max(model_s, run.back());
    }
  }
  return recorded_s > 0 ? std::clamp(model_s, recorded_s, kMore * recorded_s) : model_s;
}

void add_curves(Drawing& drawing, const Vector2d& corner, const Vector2d& size,
                const ComparedExperiment& experiment) {
  Axes axes(drawing, corner, size,
            {1.03 * last_time_s(experiment), 1.05 * static_cast<double>(experiment.people)});
  axes.draw(experiment.name, "time, s", "people");
  const std::size_t models = experiment.passages_s.size();
  constexpr double kBandOpacity = 0.25;
  for (std::size_t model = 0; model < models; ++model) {
    const Band band = passages_band(experiment.passages_s[model]);
    add_band(drawing, axes, band, model_color(model, models, kBandOpacity));
    add_line(drawing, curve_points(axes, band.median_s), model_color(model, models), 1.5);
  }
  add_line(drawing, curve_points(axes, experiment.recorded_passages_s), kInk, 2);
}

/// A point of the diagram: density, flow and half of the flow's interval.
struct Point {
  double density = 0;
  double flow = 0;
  double half = 0;
};

void add_points(Drawing& drawing, const Axes& axes, std::vector<Point> points, const Color& color) {
  std::erase_if(points, [](const Point& point) { return !std::isfinite(point.flow); });
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.density < b.density; });
  std::vector<Vector2d> line;
  for (const Point& point : points) {
    line.push_back(axes.at(point.density, point.flow));
    add_circle(drawing, line.back(), color);
    add_line(drawing,
             {axes.at(point.density, std::max(0.0, point.flow - point.half)),
              axes.at(point.density, point.flow + point.half)},
             color, 1.5);
  }
  if (line.size() > 1) add_line(drawing, line, color, 1.5);
}

}  // namespace

std::optional<Drawing> curves_plot(const Comparison& comparison) {
  constexpr std::size_t kColumns = 3;
  const Vector2d size(270, 180);
  const Vector2d panel = size + Vector2d(kLeftPx + kRightPx, kTopPx + kBottomPx);
  Drawing drawing;
  drawing.title = "Numbers of people who have passed";
  std::size_t panels = 0;
  for (const ComparedExperiment& experiment : comparison.experiments) {
    if (experiment.people == 0) continue;
    const std::size_t row = panels / kColumns;
    const Vector2d cell(static_cast<double>(panels % kColumns), static_cast<double>(row));
    add_curves(drawing, cell.cwiseProduct(panel) + Vector2d(kLeftPx, kLegendPx + kTopPx), size,
               experiment);
    ++panels;
  }
  if (panels == 0) return std::nullopt;
  const std::size_t rows = (panels + kColumns - 1) / kColumns;
  drawing.width_px = static_cast<int>(panel.x() * static_cast<double>(std::min(panels, kColumns)));
  drawing.height_px = static_cast<int>(kLegendPx + panel.y() * static_cast<double>(rows));
  add_legend(drawing, comparison);
  return drawing;
}

std::optional<Drawing> diagram_plot(const Comparison& comparison) {
  const Vector2d size(560, 360);
  std::vector<std::vector<std::vector<Point>>> lines;  // by experiment; then recorded and models
  Vector2d max = Vector2d::Zero();
  for (const ComparedExperiment& experiment : comparison.experiments) {
    std::vector<std::vector<Point>> series(comparison.models.size() + 1);
    for (const ComparedQuantity& quantity : experiment.quantities) {
      if (quantity.at_density <= 0) continue;
      series[0].push_back({quantity.at_density, quantity.recorded, 0});
      for (std::size_t model = 0; model < quantity.models.size(); ++model) {
        const Sample& sample = quantity.models[model];
        series[model + 1].push_back({quantity.at_density, sample.mean(), sample.half_interval()});
      }
    }
    for (const std::vector<Point>& points : series) {
      for (const Point& point : points) {
        if (!std::isfinite(point.flow)) continue;
        max = max.cwiseMax(Vector2d(point.density, point.flow + point.half));
      }
    }
    lines.push_back(std::move(series));
  }
  if (max.x() <= 0) return std::nullopt;
  Drawing drawing;
  drawing.title = "Flow against density";
  drawing.width_px = static_cast<int>(size.x() + kLeftPx + kRightPx);
  drawing.height_px = static_cast<int>(kLegendPx + size.y() + kTopPx + kBottomPx);
  Axes axes(drawing, {kLeftPx, kLegendPx + kTopPx}, size, 1.08 * max.cwiseMax(Vector2d(0.1, 0.1)));
  axes.draw("", "density, 1/m²", "flow, 1/(m s)");
  for (const auto& series : lines) {
    for (std::size_t i = series.size(); i-- > 0;) {
      add_points(drawing, axes, series[i],
                 i == 0 ? kInk : model_color(i - 1, comparison.models.size()));
    }
  }
  add_legend(drawing, comparison);
  return drawing;
}

}  // namespace throng::validation
