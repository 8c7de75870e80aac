// A line chart as a self-contained SVG: no scripts, no fonts of its own, nothing to fetch.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace throng::study {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

/// y runs from 0 to 100, x from 0 to the last point.
struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
};

std::string svg_of(const Chart& chart);

}  // namespace throng::study
