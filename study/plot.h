// A plot in SVG with axes of any range: lines, areas, tiles and dots. No scripts, nothing to fetch.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

namespace throng::study {

struct PlotRange {
  double low = 0;
  double high = 1;
};

class Plot {
 public:
  struct Labels {
    std::string title;
    std::string x;
    std::string y;
  };

  /// With `same_scale`, a unit is as long in y as in x, and the plot as high as that takes.
  Plot(Labels labels, PlotRange x, PlotRange y, bool same_scale = false);

  /// `colour` is a colour of SVG.
  void line(std::span<const Eigen::Vector2d> points, const std::string& colour, double width = 1.5,
            double opacity = 1);
  void area(std::span<const Eigen::Vector2d> corners, const std::string& colour,
            double opacity = 1);
  void tile(const Eigen::Vector2d& min, const Eigen::Vector2d& max, const std::string& colour);
  void dot(const Eigen::Vector2d& place, const std::string& colour, double opacity = 0.3);
  /// Beside the plot, below the last entry.
  void legend(const std::string& name, const std::string& colour);
  /// Left of the y axis, instead of numbers.
  void row_name(double y, const std::string& name);

  std::string svg() const;

 private:
  double x_px(double value) const;
  double y_px(double value) const;
  std::string axes() const;

  Labels labels_;
  PlotRange x_, y_;
  double height_px_;
  bool numbered_rows_ = true;
  int legends_ = 0;
  std::string body_;
};

/// 1, 2 or 5 times a power of ten: about six of them in the range.
double nice_step(double range);

/// Text with what HTML and SVG would take for markup made harmless.
std::string escaped_markup(const std::string& text);

}  // namespace throng::study
