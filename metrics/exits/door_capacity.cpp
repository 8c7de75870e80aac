#include "metrics/exits/door_capacity.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace throng::metrics {

namespace {

constexpr std::size_t kWidths = 10;
constexpr std::array<double, kWidths> kWidthsM = {0.8, 1, 1.2, 1.6, 2, 3, 4, 6, 10, 20};

struct ModelRow {
  std::string_view model;
  std::array<double, kWidths> rate_per_s;
  std::array<double, kWidths> burst;
};

// clang-format off
// Columns rate/s and burst of `build/release/scripts/studies/door_capacity` (four seeds). johansson and
// karamouzas do not keep bodies apart, so that people pass through each other and through jambs.
constexpr std::array kModels = {
    ModelRow{"ttc",
             {2.25, 2.65, 3.05, 4, 4.95, 7.3, 9.4, 13.75, 22.45, 43.6},
             {2, 2.1, 2, 2, 3, 3.7, 5, 8.5, 12.6, 25.4}},
    ModelRow{"orca",
             {4.1, 5.5, 7.05, 9.7, 13.2, 26.3, 36.7, 48.95, 76.12, 148.62},
             {7.3, 13, 7.6, 12.3, 18.6, 42, 113, 166.6, 179.8, 189.3}},
    ModelRow{"weidmann",
             {2.6, 3.1, 3.75, 5.35, 6.75, 10.55, 13.75, 20.95, 30.15, 48.85},
             {2.6, 3.6, 3, 3.3, 3.8, 4.7, 6.8, 7.6, 13.8, 25.1}},
    ModelRow{"helbing",
             {3.7, 4.7, 5.75, 8.05, 10.8, 17.6, 23.05, 37.45, 64.21, 147.69},
             {12.2, 19.2, 18.5, 19.8, 25.2, 31.4, 38.8, 55.2, 96.5, 230.5}},
    ModelRow{"zanlungo",
             {2.05, 2.9, 3.5, 4.4, 5.65, 9.05, 12.5, 20.5, 37.1, 81},
             {7.4, 7.1, 6.5, 12.4, 12.5, 23.5, 26, 30, 37.4, 48}},
    ModelRow{"gcf",
             {0.45, 0.65, 1, 1.45, 2, 3.05, 4.1, 6, 10.15, 20.65},
             {1.6, 3.1, 2, 3, 4, 5.7, 7.3, 12, 17.8, 33.7}},
    ModelRow{"pedvo",
             {0.95, 1.2, 1.55, 2.1, 2.95, 4.85, 6.55, 9.85, 14.9, 26.85},
             {2.2, 3, 3.2, 5.5, 5.2, 4.3, 6.7, 6.3, 7.2, 27.3}},
    ModelRow{"karamouzas",
             {0, 5.25, 20, 30.3, 35.67, 41.47, 48.12, 62.07, 87.14, 148.38},
             {0, 6.2, 26, 81, 111, 147.2, 148.1, 167.5, 184, 303.3}},
    ModelRow{"johansson",
             {61, 61.22, 64.56, 68, 71.89, 78.89, 86.44, 104.56, 152.88, 242.38},
             {94, 93.4, 101.1, 106, 104.8, 114.8, 122.9, 141.1, 67.8, 103.8}},
};
// clang-format on

const ModelRow& model_row(std::string_view model) {
  const auto named = [](std::string_view name) {
    return std::find_if(kModels.begin(), kModels.end(),
                        [name](const ModelRow& row) { return row.model == name; });
  };
  const auto* const found = named(model);
  return found != kModels.end() ? *found : *named("ttc");
}

double at(const std::array<double, kWidths>& values, double width_m) {
  if (width_m <= kWidthsM.front()) return values.front();
  if (width_m >= kWidthsM.back()) return values.back() * width_m / kWidthsM.back();
  const auto above = static_cast<std::size_t>(
      std::upper_bound(kWidthsM.begin(), kWidthsM.end(), width_m) - kWidthsM.begin());
  const double share = (width_m - kWidthsM[above - 1]) / (kWidthsM[above] - kWidthsM[above - 1]);
  return values[above - 1] + share * (values[above] - values[above - 1]);
}

}  // namespace

DoorCapacity door_capacity(std::string_view model, double width_m) {
  const ModelRow& row = model_row(model);
  // Through the narrowest door some models let nobody pass; a bound must not closed it.
  constexpr double kMinPerS = 0.3;
  return {at(row.burst, width_m), std::max(kMinPerS, at(row.rate_per_s, width_m))};
}

}  // namespace throng::metrics
