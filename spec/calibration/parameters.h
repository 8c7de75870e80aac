// Lens parameters that a calibration estimates: their names, which of them are free, and their
// priors.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera.h"

namespace throng::calibrate {

/// Lens models by what they estimate beside focal lengths and principal point. brownN:
/// Brown-Conrady with the first N coefficients of OpenCV's order (k1, k2, p1, p2, k3, k4, k5, k6);
/// fisheye: Kannala-Brandt's k1 to k4 (camera/distortion.h).
enum class Lens { pinhole, brown2, brown4, brown5, brown8, fisheye };

inline constexpr std::array kLenses = {Lens::pinhole, Lens::brown2, Lens::brown4,
                                       Lens::brown5,  Lens::brown8, Lens::fisheye};

std::string_view to_string(Lens lens);
/// Throws InputError naming `source` for any other word.
Lens lens_named(std::string_view name, const std::string& source);

/// fx, fy, cx, cy, skew (px), then the eight places of camera::Distortion's coefficients.
inline constexpr std::size_t kParameters = 13;
inline constexpr std::size_t kFx = 0;
inline constexpr std::size_t kFy = 1;
inline constexpr std::size_t kCx = 2;
inline constexpr std::size_t kCy = 3;
inline constexpr std::size_t kSkew = 4;
inline constexpr std::size_t kCoefficients = 5;  ///< where they begin
using Parameters = std::array<double, kParameters>;

/// "fx" to "k6"; a fisheye's coefficients are k1 to k4. Empty for a place that the lens has not.
std::string parameter_name(Lens lens, std::size_t index);

/// The pixel's grid leans by `skew`: u = fx x' + skew y' + cx, v = fy y' + cy (Zhang 2000, eq. 1).
camera::Intrinsics to_intrinsics(Lens lens, const Parameters& parameters, int width, int height);
/// The reverse; the camera must be of the lens's family.
Parameters to_parameters(const camera::Intrinsics& intrinsics);

/// Normally distributed knowledge of a parameter.
struct Prior {
  double mean = 0;
  double sd = 1;
};

/// `to` times `ratio` is what the parameter has.
struct Tie {
  std::string to;
  double ratio = 1;
};

/// A user's settings for parameters, by name.
struct Wishes {
  bool skew = false;  ///< estimate it; else it is 0
  /// Kept at a value; nothing: at its first guess (the image's middle, no distortion).
  std::map<std::string, std::optional<double>> fixed;
  std::map<std::string, Tie> tied;
  std::map<std::string, Prior> priors;
};

/// The same by the parameters' places, checked.
struct Rules {
  std::array<bool, kParameters> free{};
  /// Parameter i is `ratio[i]` times parameter `source[i]`, which is itself but for tied ones.
  std::array<std::size_t, kParameters> source{};
  Parameters ratio{};
  std::array<std::optional<Prior>, kParameters> priors;
  Parameters fixed{};  ///< of those that are neither free nor tied; NaN: the first guess

  /// Places of the free parameters.
  std::vector<std::size_t> free_places() const;
};

/// Throws InputError naming `source` for parameters that the lens has not, for ties in a circle or
/// to what is tied itself, and for a parameter that is given as more than one of fixed, tied and
/// known.
Rules calibration_rules(Lens lens, const Wishes& wishes, const std::string& source);

/// Gives tied parameters their values.
void apply_ties(const Rules& rules, Parameters& parameters);

}  // namespace throng::calibrate
