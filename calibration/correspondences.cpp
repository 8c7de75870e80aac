#include "calibration/correspondences.h"

#include <fmt/core.h>

#include <Eigen/SVD>
#include <algorithm>
#include <charconv>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "calibration/table.h"

namespace throng::calibrate {

namespace {

template <typename Vector>
std::size_t twins_in(const std::vector<Vector>& list) {
  std::set<std::vector<double>> seen;
  std::size_t twins = 0;
  for (const Vector& v : list) {
    if (!seen.insert(std::vector<double>(v.data(), v.data() + v.size())).second) ++twins;
  }
  return twins;
}

bool all_finite(const View& view) {
  return std::all_of(view.points.begin(), view.points.end(),
                     [](const auto& p) { return p.allFinite(); }) &&
         std::all_of(view.pixels.begin(), view.pixels.end(),
                     [](const auto& p) { return p.allFinite(); });
}

/// Ratio of the second largest extent of the points to the largest: 0 in a line.
double flatness_to_line(const std::vector<Eigen::Vector3d>& points) {
  Eigen::MatrixXd all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = points[i];
  all.colwise() -= all.rowwise().mean().eval();
  const Eigen::Vector3d extents = (all * all.transpose()).jacobiSvd().singularValues();
  return extents[0] > 0 ? std::sqrt(extents[1] / extents[0]) : 0;
}

// A single point outside may be an outlier, which the solver finds; a tenth of all are not.
bool is_of_another_size(const View& view, const ImageSize& size) {
  constexpr double kShare = 0.1;
  const auto outside = std::count_if(view.pixels.begin(), view.pixels.end(),
                                     [&](const Eigen::Vector2d& p) { return is_outside(p, size); });
  return static_cast<double>(outside) > kShare * static_cast<double>(view.pixels.size());
}

void check_image_size(const Correspondences& all) {
  constexpr std::ptrdiff_t kOneIn = 4;
  const auto wrong = std::count_if(all.views.begin(), all.views.end(), [&](const View& view) {
    return all_finite(view) && is_of_another_size(view, all.size);
  });
  if (wrong == 0 || kOneIn * wrong < static_cast<std::ptrdiff_t>(all.views.size())) return;
  Eigen::Vector2d max_pixel = Eigen::Vector2d::Zero();
  for (const View& view : all.views) {
    for (const Eigen::Vector2d& pixel : view.pixels) {
      if (pixel.allFinite()) max_pixel = max_pixel.cwiseMax(pixel);
    }
  }
  throw InputError(
      Problem{"", "/size", fmt::format("{} x {}", all.size.width, all.size.height),
              fmt::format("the images' own size: {} of {} images have points outside of this one, "
                          "which reach to pixel ({:.0f}, {:.0f})",
                          wrong, all.views.size(), max_pixel.x(), max_pixel.y())});
}

struct Reading {
  View view;
  std::vector<Problem> problems;
};

}  // namespace

bool is_outside(const Eigen::Vector2d& pixel, const ImageSize& size) {
  constexpr double kSlackPx = 1.5;  // the border lies half a pixel beyond the last pixel's center
  return pixel.x() < -kSlackPx || pixel.x() > size.width - 1 + kSlackPx || pixel.y() < -kSlackPx ||
         pixel.y() > size.height - 1 + kSlackPx;
}

std::vector<Problem> list_problems(const View& view, const ImageSize& size) {
  const auto problem = [&](std::string found, std::string expected) {
    return std::vector<Problem>{{view.name, "", std::move(found), std::move(expected)}};
  };
  if (!all_finite(view)) return problem("coordinates that are not finite", "finite numbers");
  if (view.points.size() < kMinPoints) {
    return problem(fmt::format("{} points", view.points.size()),
                   fmt::format("at least {}", kMinPoints));
  }
  if (const std::size_t twins = twins_in(view.points); twins > 0) {
    return problem(fmt::format("{} points given twice", twins), "each point of the world once");
  }
  if (const std::size_t twins = twins_in(view.pixels); twins > 0) {
    return problem(fmt::format("{} pixels given twice", twins), "each pixel for one point");
  }
  if (is_of_another_size(view, size)) {
    return problem(fmt::format("pixels outside an image of {} x {}", size.width, size.height),
                   "pixels of an image of this size");
  }
  constexpr double kLine = 1e-3;
  if (flatness_to_line(view.points) < kLine) return problem("points in a line", "points beside it");
  return {};
}

void leave_out_bad_views(Correspondences& all) {
  check_image_size(all);
  std::vector<View> good;
  for (View& view : all.views) {
    std::vector<Problem> problems = list_problems(view, all.size);
    if (problems.empty()) {
      good.push_back(std::move(view));
    } else {
      all.left_out.insert(all.left_out.end(), problems.begin(), problems.end());
    }
  }
  all.views = std::move(good);
}

Correspondences read_correspondences(const std::filesystem::path& file, const ImageSize& size) {
  const Table table = read_table(file, {"image", "X", "Y", "Z", "u", "v"});
  std::vector<std::string> order;
  std::map<std::string, Reading> readings;
  for (const TableRow& row : table.rows) {
    Reading& reading = readings[row.cells[0]];
    if (reading.view.name.empty()) {
      reading.view.name = row.cells[0].empty() ? "(no name)" : row.cells[0];
      order.push_back(row.cells[0]);
    }
    std::array<double, 5> numbers{};
    bool good = true;
    for (std::size_t i = 0; i < numbers.size() && good; ++i) {
      const std::optional<double> value = number_in(row.cells[i + 1]);
      if (!value) {
        reading.problems.push_back({file.string(),
                                    fmt::format("line {}, image {}", row.line, reading.view.name),
                                    fmt::format("\"{}\"", row.cells[i + 1]), "a finite number"});
        good = false;
      }
      numbers[i] = value.value_or(0);
    }
    reading.view.points.emplace_back(numbers[0], numbers[1], numbers[2]);
    reading.view.pixels.emplace_back(numbers[3], numbers[4]);
  }
  Correspondences all;
  all.size = size;
  for (const std::string& name : order) {
    Reading& reading = readings[name];
    if (reading.problems.empty()) {
      all.views.push_back(std::move(reading.view));
    } else {
      all.left_out.push_back(reading.problems.front());
    }
  }
  leave_out_bad_views(all);
  if (all.views.empty()) throw InputError(all.left_out);
  return all;
}

}  // namespace throng::calibrate
