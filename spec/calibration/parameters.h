// The lens parameters of a calibration: their names, the constraints on them, and their priors.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera.h"

namespace throng::calibrate {

/// Lens models, distinguished by the distortion coefficients that are estimated. brownN:
/// Brown-Conrady with the first N coefficients in OpenCV's order (k1, k2, p1, p2, k3, k4, k5, k6);
/// fisheye: Kannala-Brandt with k1 to k4 (camera/distortion.h).
enum class Lens { pinhole, brown2, brown4, brown5, brown8, fisheye };

inline constexpr std::array kLenses = {Lens::pinhole, Lens::brown2, Lens::brown4,
                                       Lens::brown5,  Lens::brown8, Lens::fisheye};

std::string_view to_string(Lens lens);
/// The inverse of to_string(). Throws InputError naming `source` for any other word.
Lens lens_named(std::string_view name, const std::string& source);

/// Number of parameters: fx, fy, cx, cy, skew (px), then the eight coefficients of
/// camera::Distortion (those that the lens does not have are 0).
inline constexpr std::size_t kParameters = 13;
inline constexpr std::size_t kFx = 0;
inline constexpr std::size_t kFy = 1;
inline constexpr std::size_t kCx = 2;
inline constexpr std::size_t kCy = 3;
inline constexpr std::size_t kSkew = 4;
inline constexpr std::size_t kCoefficients = 5;  ///< index of the first coefficient
using Parameters = std::array<double, kParameters>;

/// Name of the parameter at an index, "fx" to "k6" (of a fisheye: to "k4"). Returns "" if the lens
/// does not have this parameter.
std::string parameter_name(Lens lens, std::size_t index);

/// Camera with these parameters: u = fx x' + skew y' + cx, v = fy y' + cy (Zhang 2000, eq. 1),
/// where (x', y') are distorted normalized coordinates. `width` and `height` in pixels.
camera::Intrinsics to_intrinsics(Lens lens, const Parameters& parameters, int width, int height);

/// A normal prior of a parameter.
struct Prior {
  double mean = 0;
  double sd = 1;
};

/// Constrains a parameter to `ratio` times the parameter named `to`.
struct Tie {
  std::string to;
  double ratio = 1;
};

/// A user's settings for parameters, by name.
struct ParameterSettings {
  bool skew = false;  ///< whether the skew is estimated; else it is 0
  /// Parameters that are not estimated, with their values. Without a value (not permitted for fx
  /// and fy), the parameter keeps its initial guess: cx and cy the image's center, others 0.
  std::map<std::string, std::optional<double>> fixed;
  std::map<std::string, Tie> tied;
  std::map<std::string, Prior> priors;
};

/// The settings in `ParameterSettings`, checked and addressed by the parameters' indices.
struct Rules {
  std::array<bool, kParameters> free{};
  /// Parameter i is `ratio[i]` times parameter `source[i]`; a parameter that is not tied has
  /// source[i] = i and ratio[i] = 1.
  std::array<std::size_t, kParameters> source{};
  Parameters ratio{};
  std::array<std::optional<Prior>, kParameters> priors;
  Parameters fixed{};  ///< values of fixed parameters; NaN: the initial guess

  /// Indices of the free parameters, ascending.
  std::vector<std::size_t> free_places() const;
};

/// Checks the user's settings for a lens. Throws InputError naming `source` for parameters that the
/// lens does not have, ties to the parameter itself or to a tied parameter, a parameter that has
/// more than one of a fixed value, a tie and a prior, fx or fy fixed without a value, and a prior
/// whose standard deviation is not above 0.
Rules calibration_rules(Lens lens, const ParameterSettings& settings, const std::string& source);

/// Sets the tied parameters to their values.
void apply_ties(const Rules& rules, Parameters& parameters);

}  // namespace throng::calibrate
