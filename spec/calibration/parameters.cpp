#include "spec/calibration/parameters.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "base/error.h"

namespace throng::calibrate {

namespace {

constexpr std::array kLensNames = {"pinhole", "brown2", "brown4", "brown5", "brown8", "fisheye"};
constexpr std::array kCommonNames = {"fx", "fy", "cx", "cy", "skew"};
constexpr std::array kBrownNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};

std::size_t count_coefficients(Lens lens) {
  constexpr std::array<std::size_t, 6> kCounts = {0, 2, 4, 5, 8, 4};
  return kCounts.at(static_cast<std::size_t>(lens));
}

std::vector<std::string> parameter_names(Lens lens) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kParameters; ++i) {
    std::string name = parameter_name(lens, i);
    if (!name.empty()) names.push_back(std::move(name));
  }
  return names;
}

std::size_t parameter_index(Lens lens, const std::string& name, const std::string& source) {
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (!name.empty() && parameter_name(lens, i) == name) return i;
  }
  throw InputError(Problem{source, "", fmt::format("a parameter \"{}\"", name),
                           fmt::format("one of {}, which the lens {} has",
                                       fmt::join(parameter_names(lens), ", "), to_string(lens))});
}

void refuse_twice(const ParameterSettings& settings, const std::string& name,
                  const std::string& source) {
  const auto times =
      settings.fixed.count(name) + settings.tied.count(name) + settings.priors.count(name);
  if (times > 1) {
    throw InputError(Problem{source, "", fmt::format("\"{}\" more than once", name),
                             "each parameter fixed, tied or with a prior"});
  }
}

}  // namespace

std::string_view to_string(Lens lens) { return kLensNames.at(static_cast<std::size_t>(lens)); }

Lens lens_named(std::string_view name, const std::string& source) {
  const auto* found = std::find(kLensNames.begin(), kLensNames.end(), name);
  if (found == kLensNames.end()) {
    throw InputError(Problem{source, "", fmt::format("\"{}\"", name),
                             fmt::format("one of: {}", fmt::join(kLensNames, ", "))});
  }
  return static_cast<Lens>(found - kLensNames.begin());
}

std::string parameter_name(Lens lens, std::size_t index) {
  if (index < kCoefficients) return kCommonNames.at(index);
  const std::size_t coefficient = index - kCoefficients;
  if (coefficient >= count_coefficients(lens)) return "";
  if (lens == Lens::fisheye) return fmt::format("k{}", coefficient + 1);
  return kBrownNames.at(coefficient);
}

camera::Intrinsics to_intrinsics(Lens lens, const Parameters& p, int width, int height) {
  camera::Intrinsics k{width, height, p[kFx], p[kFy], p[kCx], p[kCy]};
  k.skew_px = p[kSkew];
  // Tilted and distorted lenses are rendered in the same manner.
  if (lens == Lens::pinhole && k.skew_px == 0) return k;
  camera::Distortion::Coefficients coefficients{};
  std::copy(p.begin() + kCoefficients, p.end(), coefficients.begin());
  k.distortion =
      camera::Distortion(lens == Lens::fisheye ? camera::Distortion::Model::fisheye
                                               : camera::Distortion::Model::brown_conrady,
                         coefficients);
  return k;
}

std::vector<std::size_t> Rules::free_places() const {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (free[i]) places.push_back(i);
  }
  return places;
}

Rules calibration_rules(Lens lens, const ParameterSettings& settings, const std::string& source) {
  Rules rules;
  rules.ratio.fill(1);
  rules.fixed.fill(0);
  for (std::size_t i = 0; i < kParameters; ++i) {
    rules.source[i] = i;
    rules.free[i] = !parameter_name(lens, i).empty() && (i != kSkew || settings.skew);
  }
  for (const auto& [name, value] : settings.fixed) {
    const std::size_t i = parameter_index(lens, name, source);
    refuse_twice(settings, name, source);
    if (!value && (i == kFx || i == kFy)) {
      throw InputError(Problem{source, "", fmt::format("{} fixed without a value", name),
                               fmt::format("{}=PIXELS", name)});
    }
    rules.free[i] = false;
    const double guess = i == kCx || i == kCy ? std::numeric_limits<double>::quiet_NaN() : 0;
    rules.fixed[i] = value.value_or(guess);
  }
  for (const auto& [name, tie] : settings.tied) {
    const std::size_t i = parameter_index(lens, name, source);
    refuse_twice(settings, name, source);
    const std::size_t to = parameter_index(lens, tie.to, source);
    if (to == i || settings.tied.count(tie.to) > 0) {
      throw InputError(Problem{source, "", fmt::format("{} tied to {}", name, tie.to),
                               "a tie to another parameter, which is not tied itself"});
    }
    rules.free[i] = false;
    rules.source[i] = to;
    rules.ratio[i] = tie.ratio;
  }
  for (const auto& [name, prior] : settings.priors) {
    if (!(prior.sd > 0)) {
      throw InputError(Problem{source, "",
                               fmt::format("a prior of {} with deviation {}", name, prior.sd),
                               "a deviation above 0"});
    }
    rules.priors.at(parameter_index(lens, name, source)) = prior;
  }
  return rules;
}

void apply_ties(const Rules& rules, Parameters& parameters) {
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (rules.source[i] != i) parameters[i] = rules.ratio[i] * parameters[rules.source[i]];
  }
}

}  // namespace throng::calibrate
