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
             {1.1, 1.45, 2, 2.75, 3.6, 6.05, 8.65, 13.65, 20.35, 36.75},
             {2.4, 3.1, 3, 3.5, 3.4, 3, 5.3, 6.3, 10.6, 24.2}},
    ModelRow{"orca",
             {2.25, 3.5, 4.85, 6.25, 8.25, 14.5, 21.2, 35, 58.35, 96.2},
             {5.5, 5, 5.7, 9.2, 10.2, 20.5, 33.4, 65, 99.9, 211.2}},
    ModelRow{"weidmann",
             {1.55, 2.4, 3.05, 4.05, 4.9, 7.5, 10, 14.7, 23.3, 44.8},
             {4.4, 3, 2, 3.8, 5.4, 7, 5, 6.9, 11.5, 30}},
    ModelRow{"helbing",
             {1.45, 2.15, 2.8, 4.15, 5.85, 10.05, 13.85, 23.2, 45.95, 96.3},
             {3.5, 3.6, 3.8, 5.8, 5.7, 6.7, 7.8, 7.4, 19.4, 69.4}},
    ModelRow{"zanlungo",
             {1.6, 1.8, 2.05, 3.05, 4.05, 6.1, 8.45, 14.5, 25.7, 57.6},
             {4.2, 4.8, 6.6, 8.7, 7.6, 16.3, 17, 18.5, 34, 26.6}},
    ModelRow{"gcf",
             {0.3, 0.45, 0.7, 1.1, 1.55, 2.6, 3.55, 5.6, 9.5, 19.8},
             {2.5, 2.9, 2.9, 3.7, 4.2, 6.4, 7.8, 11.8, 21, 40.8}},
    ModelRow{"pedvo",
             {0.6, 0.9, 1.3, 1.9, 2.5, 3.95, 5.4, 8.05, 13.8, 24.6},
             {1.6, 1.7, 2.2, 2.8, 4, 4.2, 4.2, 3.9, 6.8, 16.4}},
    ModelRow{"karamouzas",
             {0, 0.3, 14.7, 29.05, 33.68, 44.12, 51.27, 66.36, 94.08, 160.42},
             {0, 2.3, 13.9, 84.6, 125.8, 152, 165.9, 194.9, 231.5, 351.5}},
    ModelRow{"johansson",
             {61.11, 61.22, 64.56, 68, 71.89, 78.89, 86.44, 104.56, 152.88, 242.38},
             {94.2, 92.4, 100.1, 106, 104.7, 114.8, 122.9, 142.1, 70.8, 104.8}},
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
