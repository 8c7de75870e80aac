#include "study/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "study/plot.h"

namespace throng::study {

namespace {

// Colours that people with any kind of colour vision can tell apart (Okabe and Ito 2008), the first
// for the baseline; dashes tell later curves apart once the colours come again.
constexpr std::array kColours{"#555555", "#E69F00", "#56B4E9", "#009E73",
                              "#D55E00", "#0072B2", "#CC79A7"};

constexpr double kWidth = 720;
constexpr double kHeight = 420;
constexpr double kLeft = 62;
constexpr double kRight = 190;  // room for the legend
constexpr double kTop = 44;
constexpr double kBottom = 52;
constexpr double kHighest = 100;

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {
    for (const Curve& curve : chart.curves) {
      for (const auto& point : curve.points) x_max_ = std::max(x_max_, point.first);
    }
  }

  std::string svg() {
    add(R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" font-family="sans-serif" font-size="12">)svg"
        "\n",
        kWidth, kHeight);
    add(R"svg(<rect width="{}" height="{}" fill="white"/>)svg"
        "\n",
        kWidth, kHeight);
    add(R"svg(<text x="{}" y="24" font-size="15" font-weight="bold">{}</text>)svg"
        "\n",
        kLeft, escaped_markup(chart_.title));
    axes();
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) curve(i);
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  double x(double value) const { return kLeft + value / x_max_ * (kWidth - kLeft - kRight); }
  static double y(double value) {
    return kHeight - kBottom - value / kHighest * (kHeight - kTop - kBottom);
  }

  void axes() {
    for (double value = 0; value <= kHighest; value += 20) {
      add(R"svg(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="#dddddd"/>)svg"
          R"svg(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{:g}</text>)svg"
          "\n",
          kLeft, y(value), x(x_max_), y(value), kLeft - 6, y(value) + 4, value);
    }
    const double step = nice_step(x_max_);
    for (double value = 0; value <= x_max_ * (1 + 1e-9); value += step) {
      add(R"svg(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="#dddddd"/>)svg"
          R"svg(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{:g}</text>)svg"
          "\n",
          x(value), kTop, x(value), y(0), x(value), y(0) + 17, value);
    }
    add(R"svg(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)svg"
        "\n",
        0.5 * (kLeft + x(x_max_)), kHeight - 12, escaped_markup(chart_.x_label));
    add(R"svg(<text transform="translate(16 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg"
        "\n",
        0.5 * (y(0) + kTop), escaped_markup(chart_.y_label));
  }

  void curve(std::size_t i) {
    const Curve& curve = chart_.curves[i];
    const char* colour = kColours[i % kColours.size()];
    const char* dash = i < kColours.size() ? "" : R"svg( stroke-dasharray="5 3")svg";
    add(R"svg(<polyline fill="none" stroke="{}" stroke-width="2"{} points=")svg", colour, dash);
    for (const auto& [time, share] : curve.points) add("{:.1f},{:.1f} ", x(time), y(share));
    text_ += "\"/>\n";
    const double legend_x = x(x_max_) + 14;
    const double legend_y = kTop + 10 + 20 * static_cast<double>(i);
    add(R"svg(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="2"{}/>)svg"
        R"svg(<text x="{:.1f}" y="{:.1f}">{}</text>)svg"
        "\n",
        legend_x, legend_y, legend_x + 22, legend_y, colour, dash, legend_x + 28, legend_y + 4,
        escaped_markup(curve.name));
  }

  const Chart& chart_;
  double x_max_ = 1;
  std::string text_;
};

}  // namespace

std::string svg_of(const Chart& chart) { return Drawing(chart).svg(); }

}  // namespace throng::study
