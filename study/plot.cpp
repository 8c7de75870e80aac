#include "study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace throng::study {

using Eigen::Vector2d;

namespace {

constexpr double kPlotWidth = 760;
constexpr double kPlotLeft = 74;
constexpr double kPlotRight = 150;
constexpr double kPlotTop = 36;
constexpr double kPlotBottom = 48;
constexpr double kUsualHeight = 360;
constexpr double kMostHeight = 1100;

}  // namespace

double nice_step(double range) {
  const double rough = std::max(range, 1e-9) / 6;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= rough) return step * power;
  }
  return 10 * power;
}

std::string escaped_markup(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

Plot::Plot(Labels labels, PlotRange x, PlotRange y, bool same_scale)
    : labels_(std::move(labels)), x_(x), y_(y), height_px_(kUsualHeight) {
  if (!(x_.high > x_.low)) x_.high = x_.low + 1;
  if (!(y_.high > y_.low)) y_.high = y_.low + 1;
  if (!same_scale) return;
  const double px_per_unit = (kPlotWidth - kPlotLeft - kPlotRight) / (x_.high - x_.low);
  height_px_ = std::min(kMostHeight, px_per_unit * (y_.high - y_.low) + kPlotTop + kPlotBottom);
}

double Plot::x_px(double value) const {
  return kPlotLeft + (value - x_.low) / (x_.high - x_.low) * (kPlotWidth - kPlotLeft - kPlotRight);
}

double Plot::y_px(double value) const {
  const double inner = height_px_ - kPlotTop - kPlotBottom;
  return height_px_ - kPlotBottom - (value - y_.low) / (y_.high - y_.low) * inner;
}

void Plot::line(std::span<const Vector2d> points, const std::string& colour, double width,
                double opacity) {
  const auto out = std::back_inserter(body_);
  fmt::format_to(
      out, R"svg(<polyline fill="none" stroke="{}" stroke-width="{}" opacity="{}" points=")svg",
      colour, width, opacity);
  for (const Vector2d& point : points) {
    fmt::format_to(out, "{:.1f},{:.1f} ", x_px(point.x()), y_px(point.y()));
  }
  body_ += "\"/>\n";
}

void Plot::area(std::span<const Vector2d> corners, const std::string& colour, double opacity) {
  const auto out = std::back_inserter(body_);
  fmt::format_to(out, R"svg(<polygon fill="{}" fill-opacity="{}" points=")svg", colour, opacity);
  for (const Vector2d& corner : corners) {
    fmt::format_to(out, "{:.1f},{:.1f} ", x_px(corner.x()), y_px(corner.y()));
  }
  body_ += "\"/>\n";
}

void Plot::tile(const Vector2d& min, const Vector2d& max, const std::string& colour) {
  fmt::format_to(std::back_inserter(body_),
                 R"svg(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)svg"
                 "\n",
                 x_px(min.x()), y_px(max.y()), x_px(max.x()) - x_px(min.x()),
                 y_px(min.y()) - y_px(max.y()), colour);
}

void Plot::dot(const Vector2d& place, const std::string& colour, double opacity) {
  fmt::format_to(std::back_inserter(body_),
                 R"svg(<circle cx="{:.1f}" cy="{:.1f}" r="1.5" fill="{}" opacity="{}"/>)svg"
                 "\n",
                 x_px(place.x()), y_px(place.y()), colour, opacity);
}

void Plot::legend(const std::string& name, const std::string& colour) {
  const double left = kPlotWidth - kPlotRight + 12;
  const double top = kPlotTop + 18.0 * legends_++;
  fmt::format_to(std::back_inserter(body_),
                 R"svg(<rect x="{}" y="{}" width="14" height="10" fill="{}"/>)svg"
                 R"svg(<text x="{}" y="{}">{}</text>)svg"
                 "\n",
                 left, top, colour, left + 20, top + 9, escaped_markup(name));
}

void Plot::row_name(double y, const std::string& name) {
  numbered_rows_ = false;
  fmt::format_to(std::back_inserter(body_),
                 R"svg(<text x="{}" y="{:.1f}" text-anchor="end">{}</text>)svg"
                 "\n",
                 kPlotLeft - 6, y_px(y) + 4, escaped_markup(name));
}

std::string Plot::axes() const {
  std::string text;
  const auto out = std::back_inserter(text);
  const double x_step = nice_step(x_.high - x_.low);
  for (double value = x_step * std::ceil(x_.low / x_step); value <= x_.high + 1e-9;
       value += x_step) {
    fmt::format_to(
        out,
        R"svg(<line x1="{0:.1f}" y1="{1:.1f}" x2="{0:.1f}" y2="{2:.1f}" stroke="#ddd"/>)svg"
        R"svg(<text x="{0:.1f}" y="{3:.1f}" text-anchor="middle">{4:g}</text>)svg"
        "\n",
        x_px(value), kPlotTop, height_px_ - kPlotBottom, height_px_ - kPlotBottom + 16,
        std::abs(value) < 1e-9 ? 0 : value);
  }
  const double y_step = nice_step(y_.high - y_.low);
  for (double value = y_step * std::ceil(y_.low / y_step);
       numbered_rows_ && value <= y_.high + 1e-9; value += y_step) {
    fmt::format_to(
        out,
        R"svg(<line x1="{0:.1f}" y1="{1:.1f}" x2="{2:.1f}" y2="{1:.1f}" stroke="#ddd"/>)svg"
        R"svg(<text x="{3:.1f}" y="{4:.1f}" text-anchor="end">{5:g}</text>)svg"
        "\n",
        kPlotLeft, y_px(value), kPlotWidth - kPlotRight, kPlotLeft - 6, y_px(value) + 4,
        std::abs(value) < 1e-9 ? 0 : value);
  }
  fmt::format_to(out,
                 R"svg(<text x="{}" y="{:.1f}" text-anchor="middle">{}</text>)svg"
                 "\n",
                 0.5 * (kPlotLeft + kPlotWidth - kPlotRight), height_px_ - 10,
                 escaped_markup(labels_.x));
  fmt::format_to(
      out,
      R"svg(<text transform="translate(16 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg"
      "\n",
      0.5 * (kPlotTop + height_px_ - kPlotBottom), escaped_markup(labels_.y));
  return text;
}

std::string Plot::svg() const {
  return fmt::format(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1:.0f}" width="{0}" height="{1:.0f}" font-family="sans-serif" font-size="12">)svg"
      R"svg(<text x="{2}" y="20" font-size="15" font-weight="bold">{3}</text>)svg"
      "\n{4}{5}</svg>\n",
      kPlotWidth, height_px_, kPlotLeft, escaped_markup(labels_.title), axes(), body_);
}

}  // namespace throng::study
