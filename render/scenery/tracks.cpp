#include "render/scenery/tracks.h"

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"
#include "render/props/prop_cells.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTrackPieceM = 12;
constexpr double kTrackGaugeM = 1.435;  // between the rails' inner sides
constexpr double kRailHeadM = 0.07;     // width of a rail's head
constexpr double kBallastM = 0.045;     // height of the ballast
constexpr double kSleeperTopM = 0.07;
const Vector3d kBallastPaint(0.105, 0.098, 0.09);
const Vector3d kSleeperPaint(0.2, 0.19, 0.175);

/// Ballast with sloping shoulders; patches differ in tone, and stones near by.
void add_ballast(PropBuilder& builder, double length_m, Random& random) {
  constexpr double kTopM = 1.65;
  constexpr double kFootM = 2.05;
  constexpr double kPatchM = 2;
  const double patches = std::max(1.0, std::round(length_m / kPatchM));
  for (double i = 0; i < patches; ++i) {
    const double a = i / patches * length_m;
    const double b = (i + 1) / patches * length_m;
    const Vector3d paint = random.uniform(0.85, 1.15) * kBallastPaint;
    const Vector3d rusty = paint.cwiseProduct(Vector3d(0.95, 0.8, 0.68));
    const auto strip = [&](double y0, double z0, double y1, double z1, const Vector3d& color) {
      builder.quad(
          {Vector3d(a, y0, z0), Vector3d(b, y0, z0), Vector3d(b, y1, z1), Vector3d(a, y1, z1)},
          color, Finish::matt);
    };
    strip(-kFootM, 0.003, -kTopM, kBallastM, paint);
    strip(-kTopM, kBallastM, -1, kBallastM, paint);
    strip(-1, kBallastM, 1, kBallastM, rusty);
    strip(1, kBallastM, kTopM, kBallastM, paint);
    strip(kTopM, kBallastM, kFootM, 0.003, paint);
  }
  constexpr double kStonesPerM = 14;
  builder.is_near = true;
  for (double i = 0; i < kStonesPerM * length_m; ++i) {
    const Vector2d at(random.uniform(0, length_m), random.uniform(-kTopM, kTopM));
    const double half = random.uniform(0.025, 0.06);
    const double turn = random.uniform(0, 1.5);
    const Vector3d u(half * std::cos(turn), half * std::sin(turn), 0);
    const Vector3d v(-u.y(), u.x(), 0.012);
    const Vector3d middle(at.x(), at.y(), kBallastM + 0.012);
    builder.quad({middle - u - v, middle + u - v, middle + u + v, middle - u + v},
                 random.uniform(0.55, 1.5) * kBallastPaint, Finish::matt);
  }
  builder.is_near = false;
}

void add_sleepers(PropBuilder& builder, double length_m, Random& random) {
  constexpr double kApartM = 0.6;
  constexpr double kHalfLengthM = 1.3;
  constexpr double kHalfWidthM = 0.13;
  const double count = std::max(1.0, std::round(length_m / kApartM));
  for (double i = 0.5; i < count; ++i) {
    const double x = i / count * length_m;
    const Vector3d paint = random.uniform(0.85, 1.1) * kSleeperPaint;
    builder.quad({Vector3d(x - kHalfWidthM, -kHalfLengthM, kSleeperTopM),
                  Vector3d(x + kHalfWidthM, -kHalfLengthM, kSleeperTopM),
                  Vector3d(x + kHalfWidthM, kHalfLengthM, kSleeperTopM),
                  Vector3d(x - kHalfWidthM, kHalfLengthM, kSleeperTopM)},
                 paint, Finish::matt);
    builder.is_near = true;
    const double side = kHalfWidthM - 0.002;
    for (const double sign : {-1.0, 1.0}) {
      const double y = sign * (0.5 * kTrackGaugeM + 0.5 * kRailHeadM);
      builder.box({x - 0.09, y - 0.13, kSleeperTopM}, {x + 0.09, y + 0.13, kSleeperTopM + 0.025},
                  {0.06, 0.05, 0.045});
      const double a = sign > 0 ? x + side : x - side;
      builder.quad({Vector3d(a, -sign * kHalfLengthM, 0.02), Vector3d(a, sign * kHalfLengthM, 0.02),
                    Vector3d(a, sign * kHalfLengthM, kSleeperTopM),
                    Vector3d(a, -sign * kHalfLengthM, kSleeperTopM)},
                   0.7 * paint, Finish::matt);
    }
    builder.is_near = false;
  }
}

void add_rails(PropBuilder& builder, double length_m) {
  const Vector3d rust(0.14, 0.075, 0.045);
  const Vector3d polished(0.45, 0.45, 0.46);
  for (const double sign : {-1.0, 1.0}) {
    const double inner = 0.5 * kTrackGaugeM;
    const double low = sign > 0 ? inner : -inner - kRailHeadM;
    builder.box({0, low, kSleeperTopM}, {length_m, low + kRailHeadM, kRailTopM - 0.002}, rust);
    builder.quad({Vector3d(0, low + 0.01, kRailTopM), Vector3d(length_m, low + 0.01, kRailTopM),
                  Vector3d(length_m, low + kRailHeadM - 0.01, kRailTopM),
                  Vector3d(0, low + kRailHeadM - 0.01, kRailTopM)},
                 polished, Finish::glossy);
  }
}

}  // namespace

std::vector<PropMesh> make_track(const world::Marking& track, std::uint32_t id) {
  PropCells cells(kTrackPieceM, id);
  const Vector2d axis = track.to - track.from;
  const Vector2d along = axis.normalized();
  const double yaw_rad = std::atan2(along.y(), along.x());
  const double pieces = std::max(1.0, std::round(axis.norm() / kTrackPieceM));
  const double length_m = axis.norm() / pieces;
  for (double k = 0; k < pieces; ++k) {
    const Vector2d from = track.from + k * length_m * along;
    PropBuilder& builder = cells.at(from + 0.5 * length_m * along);
    builder.placing =
        Eigen::Translation3d(from.x(), from.y(), 0) * Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ());
    Random random(static_cast<std::uint64_t>(k), Stream::environment, 0x72AC);
    add_ballast(builder, length_m, random);
    add_sleepers(builder, length_m, random);
    add_rails(builder, length_m);
  }
  std::vector<PropMesh> meshes;
  cells.take(meshes);
  return meshes;
}

}  // namespace throng::render
