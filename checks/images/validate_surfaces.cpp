// Classes of still surfaces against their shape and color: facades are upright, roofs and doors at
// their heights, grass green.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "checks/shares.h"
#include "checks/shot.h"
#include "world/semantic_class.h"

namespace throng::checks {

namespace {

using world::SemanticClass;

/// Sums of linear color, for a mean.
struct ColorSum {
  std::array<double, 3> sum{};
  std::size_t pixels = 0;
  double greenness() const { return sum[1] / (sum[0] + sum[1] + sum[2] + 1e-9); }
};

class SurfaceCheck {
 public:
  SurfaceCheck(const Shot& shot, Findings& findings)
      : shot_(shot),
        findings_(findings),
        visibility_m_(shot.image.record.value("environment", nlohmann::json::object())
                          .value("visibility_m", std::numeric_limits<double>::infinity())) {}

  void run() {
    const Pixels& pixels = shot_.pixels;
    constexpr int kStep = 2;
    for (int y = 1; y + 1 < pixels.height; y += kStep) {
      for (int x = 1; x + 1 < pixels.width; x += kStep) look_at(x, y);
    }
    constexpr double kMaxLow = 0.1;
    constexpr double kMaxUp = 0.4;
    report(roofs_, kMaxLow, "of roofs are less than 1.5 m above the ground");
    report(doors_, kMaxLow, "of doors are more than 6 m above the ground");
    report(facades_, kMaxUp, "of facades face up");
    constexpr std::size_t kMinPixels = 300;
    constexpr double kNoise = 0.01;
    if (grass_.pixels < kMinPixels || paved_.pixels < kMinPixels ||
        grass_.greenness() > paved_.greenness() - kNoise) {
      return;
    }
    fault(fmt::format("grass is less green ({:.3f}) than pavement and road ({:.3f})",
                      grass_.greenness(), paved_.greenness()));
  }

 private:
  SemanticClass class_at(int x, int y) const {
    return static_cast<SemanticClass>(shot_.pixels.semantic[shot_.pixels.at(x, y)]);
  }

  /// Whether air, smoke, fire or gas, which have any color, give a pixel some of theirs.
  bool is_veiled(std::size_t pixel) const {
    const std::vector<std::uint16_t>& opacity = shot_.pixels.hazard_opacity;
    // 2 % of a contrast are left at the visibility, two thirds at a tenth of it.
    constexpr double kClearShare = 0.1;
    constexpr double kUnknownDepthM = 100;
    const bool has_depth = !shot_.pixels.depth_cm.empty();
    const double away_m = has_depth ? shot_.pixels.depth_m(pixel) : kUnknownDepthM;
    if (away_m > kClearShare * visibility_m_) return true;
    return !opacity.empty() &&
           (opacity[3 * pixel] | opacity[3 * pixel + 1] | opacity[3 * pixel + 2]) != 0;
  }

  void look_at(int x, int y) {
    const Pixels& pixels = shot_.pixels;
    const std::size_t pixel = pixels.at(x, y);
    const SemanticClass surface = class_at(x, y);
    const bool is_paved = surface == SemanticClass::road || surface == SemanticClass::pavement;
    if (!pixels.rgb.empty() && !is_veiled(pixel) && (is_paved || surface == SemanticClass::grass)) {
      ColorSum& color = is_paved ? paved_ : grass_;
      for (std::size_t c = 0; c < 3; ++c) color.sum.at(c) += pixels.rgb[3 * pixel + c];
      ++color.pixels;
    }
    if (pixels.depth_cm.empty() || pixels.depth_cm[pixel] == 0) return;
    if (surface == SemanticClass::roof || surface == SemanticClass::door) {
      const double height_m = shot_.point_at(x, y, pixels.depth_m(pixel)).z();
      constexpr double kLowestRoofM = 1.5;
      constexpr double kHighestDoorM = 6;
      if (surface == SemanticClass::roof) roofs_.add(height_m < kLowestRoofM);
      if (surface == SemanticClass::door) doors_.add(height_m > kHighestDoorM);
    }
    if (surface == SemanticClass::building && !pixels.normals.empty()) {
      constexpr std::uint16_t kUp = 128 + 100;  // of 127
      facades_.add(pixels.normals[3 * pixel + 2] > kUp);
    }
  }

  void report(const WrongTally& tally, double max_share, const char* what) const {
    if (!is_above_share(tally.wrong, tally.looked_at, max_share)) return;
    fault(fmt::format("{} of {} pixels {}", tally.wrong, tally.looked_at, what));
  }

  void fault(const std::string& what) const {
    findings_.add("semantic", raster_name("semantic", shot_.image), shot_.record(), what);
  }

  const Shot& shot_;
  Findings& findings_;
  double visibility_m_;
  WrongTally roofs_;
  WrongTally doors_;
  WrongTally facades_;
  ColorSum grass_;
  ColorSum paved_;
};

}  // namespace

void check_surface_classes(const Shot& shot, Findings& findings) {
  if (shot.pixels.semantic.empty() || !shot.at_once) return;
  SurfaceCheck(shot, findings).run();
}

}  // namespace throng::checks
