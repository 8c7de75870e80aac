// Fits the parameters of the model `weidmann` to the fundamental diagram and to the flow through
// doors, with Ceres, and prints what they give. Without --fit it prints the tables of any model.
//
//   calibrate_crowd [MODEL [seeds=7] [NAME=VALUE...]]   speed over density in a ring, specific flow
//                                                       of doors; with other constants, if named
//   calibrate_crowd --fit     the fit, from the parameters that the model has now
#include <ceres/ceres.h>
#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/compute/quantile.h"
#include "crowd/state/model.h"
#include "validation/flow.h"

namespace throng::validation {
namespace {

constexpr std::array<double, 8> kDensities = {0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4};  // 1/m^2
constexpr std::array<double, 5> kWidths = {0.8, 1.0, 1.2, 1.6, 2.0};            // m
constexpr std::array<double, 2> kWalls = {0.2, 4};                              // m

struct Tables {
  std::vector<double> speeds;              ///< by density
  std::vector<std::vector<double>> flows;  ///< by wall and width: of each seed
};

Tables measure(const Tested& tested, std::size_t seeds) {
  Tables tables;
  tables.speeds.resize(kDensities.size());
  tables.flows.assign(kWalls.size() * kWidths.size(), std::vector<double>(seeds));
  const std::size_t rings = kDensities.size();
  const std::size_t runs = rings + tables.flows.size() * seeds;
  tbb::parallel_for(std::size_t{0}, runs, [&](std::size_t run) {
    tbb::task_arena alone(1);
    alone.execute([&] {
      if (run < rings) {
        tables.speeds[run] = walk_in_ring(tested, kDensities[run], 1).speed_mps;
        return;
      }
      const std::size_t door = (run - rings) / seeds;
      const std::size_t seed = (run - rings) % seeds;
      const Bottleneck bottleneck{kWidths[door % kWidths.size()], kWalls[door / kWidths.size()]};
      tables.flows[door][seed] = specific_flow(tested, bottleneck, seed + 1);
    });
  });
  return tables;
}

void print(const Tables& tables) {
  fmt::print("density  speed  Weidmann\n");
  for (std::size_t i = 0; i < kDensities.size(); ++i) {
    fmt::print("{:7.1f} {:6.2f} {:9.2f}\n", kDensities[i], tables.speeds[i],
               weidmann_speed_mps(kDensities[i]));
  }
  fmt::print("  wall  width  specific flow: median (least - greatest)\n");
  for (std::size_t door = 0; door < tables.flows.size(); ++door) {
    const std::vector<double>& flows = tables.flows[door];
    const auto [least, greatest] = std::minmax_element(flows.begin(), flows.end());
    fmt::print("{:6.1f} {:6.1f} {:6.2f} ({:.2f} - {:.2f})\n", kWalls[door / kWidths.size()],
               kWidths[door % kWidths.size()], median(flows), *least, *greatest);
  }
}

/// The fitted parameters: shares and densities that Pace has, and the horizon of avoidance.
constexpr std::array<std::string_view, 4> kNames = {"decline", "jam_density", "least", "tau"};
using Values = std::array<double, kNames.size()>;

Tested weidmann_with(const Values& v) {
  return {
      "weidmann",
      {describe::model("Weidmann", {{"decline", v[0]}, {"jam_density", v[1]}, {"least", v[2]}})},
      {describe::model("Weidmann", {{"tau", v[3]}})}};
}

/// Deviations in units of what is tolerable: 0.1 m/s, and 0.3 /(m s) from the middle of what is
/// observed at doors (1.2 to 2.3).
struct Deviation {
  static constexpr double kSpeedScale = 0.1;
  static constexpr double kFlow = 1.75;
  static constexpr double kFlowScale = 0.3;
  static constexpr std::size_t kSeeds = 5;

  bool operator()(const double* const values, double* residuals) const {
    Values v{};
    std::copy_n(values, v.size(), v.begin());
    const Tables tables = measure(weidmann_with(v), kSeeds);
    for (std::size_t i = 0; i < kDensities.size(); ++i) {
      *residuals++ = (tables.speeds[i] - weidmann_speed_mps(kDensities[i])) / kSpeedScale;
    }
    for (const auto& flows : tables.flows) *residuals++ = (median(flows) - kFlow) / kFlowScale;
    return true;
  }
};

Values fit(Values values) {
  constexpr int kResiduals = kDensities.size() + kWalls.size() * kWidths.size();
  ceres::NumericDiffOptions steps;
  steps.relative_step_size = 0.1;  // wide: flows through doors are chaotic
  Deviation deviation;
  ceres::NumericDiffCostFunction<Deviation, ceres::CENTRAL, kResiduals, kNames.size()> cost(
      &deviation, ceres::DO_NOT_TAKE_OWNERSHIP, kResiduals, steps);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, values.data());
  constexpr std::array<double, kNames.size()> kLow = {0.5, 3, 0.02, 0.3};
  constexpr std::array<double, kNames.size()> kHigh = {5, 7, 0.3, 4};
  for (std::size_t i = 0; i < values.size(); ++i) {
    problem.SetParameterLowerBound(values.data(), static_cast<int>(i), kLow[i]);
    problem.SetParameterUpperBound(values.data(), static_cast<int>(i), kHigh[i]);
  }
  ceres::Solver::Options options;
  options.max_num_iterations = 2;  // more fit the noise of flows
  options.minimizer_progress_to_stdout = true;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  fmt::print("{}\n", summary.BriefReport());
  return values;
}

Values shipped_values() {
  const crowd::ModelEntry& entry = crowd::find_model("weidmann");
  Values values{};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    for (const auto* table : {&entry.constants, &entry.parameters}) {
      for (const crowd::ModelParameter& parameter : *table) {
        if (parameter.name == kNames[i]) values[i] = parameter.initial;
      }
    }
  }
  return values;
}

constexpr std::string_view kSeedsArgument = "seeds=";

/// Runs per door.
std::size_t seeds_named(std::span<char* const> named) {
  for (const std::string_view word : named) {
    if (word.starts_with(kSeedsArgument)) {
      return std::stoul(std::string(word.substr(kSeedsArgument.size())));
    }
  }
  return 7;
}

/// The model with constants that the command line names.
Tested with_constants(const std::string& model, std::span<char* const> named) {
  crowd::Node constants(std::string(crowd::find_model(model).tag));
  for (const std::string_view constant : named) {
    const std::size_t at = constant.find('=');
    if (at == std::string_view::npos || constant.starts_with(kSeedsArgument)) continue;
    constants.set({std::string(constant.substr(0, at)), constant.substr(at + 1)});
  }
  return {model, {constants}};
}

}  // namespace
}  // namespace throng::validation

int main(int argc, char** argv) {
  using throng::validation::fit;
  using throng::validation::kNames;
  using throng::validation::measure;
  using throng::validation::print;
  using throng::validation::seeds_named;
  using throng::validation::shipped_values;
  using throng::validation::Values;
  using throng::validation::weidmann_with;
  using throng::validation::with_constants;
  const std::string word = argc > 1 ? argv[1] : "weidmann";
  if (word != "--fit") {
    const std::span<char* const> named(argv + std::min(argc, 2), argv + argc);
    print(measure(with_constants(word, named), seeds_named(named)));
    return 0;
  }
  const Values values = fit(shipped_values());
  for (std::size_t i = 0; i < kNames.size(); ++i) fmt::print("{} {:.3f}\n", kNames[i], values[i]);
  print(measure(weidmann_with(values), seeds_named({})));
}
