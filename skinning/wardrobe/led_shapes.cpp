#include "skinning/wardrobe/led_shapes.h"

#include <cmath>

#include "skinning/items.h"

namespace throng::skinning::items {

using Eigen::Vector3f;

namespace {

// Rods of coarse shapes are too thin for their corners to be seen.
int rod_sides(const Site& site) { return site.of_shape({6, 4, 4, 3, 3}); }

// A wheel in one piece that stays where it is.
void add_disc(Shape& shape, const Vector3f& center, float radius_m, float half_m, int sides) {
  const Vector3f aside(0, half_m, 0);
  add_rod(shape, center - aside, center + aside, radius_m, kStill, kBlack, sides);
}

}  // namespace

void add_walking_stick(Shape& shape, const Site& site) {
  const Stick stick = find_stick(site.person->joints);
  const Vector3f along = (stick.tip - stick.palm).normalized();
  constexpr float kRadiusM = 0.011F;
  add_rod(shape, stick.palm, stick.tip, kRadiusM, Bone::right_hand, kDark, rod_sides(site));
  if (site.shape > 2) return;
  add_rod(shape, stick.palm - Vector3f(0.06F, 0, 0), stick.palm + Vector3f(0.05F, 0, 0), 0.014F,
          Bone::right_hand, kDark, rod_sides(site));
  add_rod(shape, stick.tip - 0.04F * along, stick.tip, 0.016F, Bone::right_hand, kBlack,
          rod_sides(site));
}

void add_suitcase(Shape& shape, const Site& site) {
  // A case for the hold (0.58 x 0.40 x 0.24 m) on two wheels, whose handle is pulled out.
  constexpr float kToHandM = 1.1F;  // from the axle
  constexpr float kWheelM = 0.04F;
  const Vector3f hand = find_grips(Carry::suitcase, site.person->joints).front().point;
  const float up = std::min(hand.z() - kWheelM, 0.95F * kToHandM);
  const Vector3f axle(hand.x() - std::sqrt(kToHandM * kToHandM - up * up), hand.y(), kWheelM);
  const Vector3f along = (hand - axle).normalized();
  const Eigen::Matrix3f turn = turn_y(std::atan2(along.x(), along.z()));
  // The case lies on the line from the wheels to the hand.
  const Vector3f back = -turn.col(0);
  const int rings = site.of_shape({8, 6, 4, 4, 3});
  const int columns = site.of_shape({16, 8, 8, 4, 4});
  add_box(
      shape,
      {axle + 0.33F * along + 0.11F * back, {0.12F, 0.2F, 0.29F}, kStill, rings, columns, turn});
  for (const float side : {-1.0F, 1.0F}) {
    const Vector3f aside(0, side, 0);
    add_disc(shape, axle + 0.17F * aside, kWheelM, 0.015F, site.of_shape({12, 8, 6, 4, 3}));
    if (site.shape > 2) continue;
    add_rod(shape, axle + 0.55F * along + 0.07F * aside, hand + 0.07F * aside, 0.008F, kStill,
            kDark, rod_sides(site));
  }
  const Vector3f half_grip(0, 0.08F, 0);
  if (site.shape <= 2) {
    add_rod(shape, hand - half_grip, hand + half_grip, 0.014F, kStill, kBlack, rod_sides(site));
  } else if (site.shape == 3) {
    add_rod(shape, axle + 0.55F * along, hand, 0.02F, kStill, kDark, 3);
  }
}

void add_pram(Shape& shape, const Site& site) {
  // A pram with a carrycot and four wheels, 1.05 m long from its handle and 0.6 m wide.
  const auto grips = find_grips(Carry::pram, site.person->joints);
  const float x = grips[0].point.x();
  const float handle = grips[0].point.z();
  constexpr float kRearM = 0.15F;  // radii of wheels
  constexpr float kFrontM = 0.11F;
  const int sides = rod_sides(site);
  const auto rod = [&](const Vector3f& from, const Vector3f& to, float radius_m,
                       const Eigen::Vector2f& uv) {
    add_rod(shape, from, to, radius_m, kStill, uv, sides);
  };
  for (const float side : {-1.0F, 1.0F}) {
    const float y = 0.24F * side;
    const Vector3f rear(x + 0.34F, 0.27F * side, kRearM);
    const Vector3f front(x + 0.9F, 0.24F * side, kFrontM);
    if (site.shape < 2) {
      add_tire(shape, rear, kRearM, 0.018F, site.of_shape({20, 12, 8, 6, 4}));
      add_tire(shape, front, kFrontM, 0.018F, site.of_shape({16, 10, 8, 6, 4}));
    }
    const float rim = site.shape < 2 ? 0.85F : 1;
    add_disc(shape, rear, rim * kRearM, 0.012F, site.of_shape({16, 10, 8, 6, 4}));
    add_disc(shape, front, rim * kFrontM, 0.012F, site.of_shape({12, 8, 6, 5, 3}));
    if (site.shape > 3) continue;
    rod({x, y, handle}, {front.x(), y, kFrontM}, 0.013F, kDark);
    rod({rear.x(), y, kRearM}, {x + 0.55F, y, 0.55F}, 0.013F, kDark);
  }
  rod({x, -0.25F, handle}, {x, 0.25F, handle}, 0.018F, kBlack);
  if (site.shape < 3) rod({x + 0.34F, -0.27F, kRearM}, {x + 0.34F, 0.27F, kRearM}, 0.01F, kDark);
  const int columns = site.of_shape({12, 8, 6, 4, 4});
  const int rings = site.of_shape({6, 6, 4, 3, 3});
  add_box(shape, {{x + 0.55F, 0, 0.72F}, {0.41F, 0.2F, 0.13F}, kStill, rings, columns});
  // The hood is at the far end: who pushes sees the child.
  add_box(shape, {{x + 0.76F, 0, 0.86F}, {0.2F, 0.21F, 0.2F}, kStill, rings, columns, turn_y(0.3)});
  if (site.shape < 2) {  // a net below
    add_box(shape, {{x + 0.6F, 0, 0.32F}, {0.24F, 0.17F, 0.08F}, kStill, 4, columns});
  }
}

void add_bicycle(Shape& shape, const Site& site) {
  // A city bicycle: wheels of 0.68 m, 1.07 m apart. It is on the right of who pushes it by the left
  // grip of the handlebar.
  constexpr float kWheelM = 0.34F;
  constexpr float kHalfBarM = 0.29F;
  const Vector3f hand = find_grips(Carry::bicycle, site.person->joints).front().point;
  const float y = hand.y() - kHalfBarM + 0.06F;
  const auto at = [&](float ahead_m, float z, float aside_m = 0) {
    return Vector3f(hand.x() + ahead_m, y + aside_m, z);
  };
  const int sides = rod_sides(site);
  const auto rod = [&](const Vector3f& from, const Vector3f& to, float radius_m,
                       const Eigen::Vector2f& uv = kPlain) {
    add_rod(shape, from, to, site.shape < 3 ? radius_m : 1.25F * radius_m, kStill, uv, sides);
  };
  const Vector3f front = at(0.42F, kWheelM);
  const Vector3f rear = at(-0.65F, kWheelM);
  const Vector3f crank = at(-0.2F, 0.28F);
  const Vector3f head = at(0.13F, 0.76F);
  const Vector3f seat = at(-0.36F, 0.78F);
  const int segments = site.of_shape({24, 20, 14, 12, 5});
  const float tube = site.of_shape({18, 18, 19, 20, 26}) / 1000.0F;  // half of a tire's width
  add_tire(shape, front, kWheelM, tube, segments);
  add_tire(shape, rear, kWheelM, tube, segments);
  rod(head, crank, 0.017F);
  rod(crank, seat + Vector3f(-0.03F, 0, 0.1F), 0.015F);
  if (site.shape > 3) return;
  rod(at(0, hand.z(), -kHalfBarM), at(0, hand.z(), kHalfBarM), 0.014F, kBlack);
  rod(at(0.1F, 0.86F), seat, 0.015F);
  if (site.shape < 3) {
    rod(at(0, hand.z()), head, 0.018F);
    for (const float side : {-0.05F, 0.05F}) {
      const Vector3f aside(0, side, 0);
      rod(head - Vector3f(0, 0, 0.05F) + 0.6F * aside, front + aside, 0.011F);
      rod(seat, rear + aside, 0.008F);
      rod(crank, rear + aside, 0.008F);
      rod(crank + aside, crank + 3 * aside + Vector3f(3.2F * side, 0, -3.2F * side), 0.011F, kDark);
    }
  } else {
    rod(head, front, 0.012F);
    rod(crank, rear, 0.01F);
    rod(seat, rear, 0.01F);
  }
  add_box(shape, {seat + Vector3f(-0.06F, 0, 0.13F),
                  {0.13F, 0.065F, 0.025F},
                  kStill,
                  site.of_shape({4, 4, 3, 3, 3}),
                  site.of_shape({8, 6, 4, 3, 3})});
  if (site.shape > 0) return;
  constexpr int kSpokes = 10;
  for (const Vector3f& axle : {front, rear}) {
    for (int i = 0; i < kSpokes; ++i) {
      const float turn = 2 * kPi * static_cast<float>(i) / kSpokes;
      add_rod(shape, axle, axle + 0.31F * Vector3f(std::cos(turn), 0, std::sin(turn)), 0.002F,
              kStill, kPlain, 3);
    }
  }
}

}  // namespace throng::skinning::items
