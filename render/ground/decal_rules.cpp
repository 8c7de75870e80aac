#include "render/ground/decal_rules.h"

namespace throng::render {

std::span<const DecalRule> decal_rules() {
  using enum DecalKind;
  using enum DecalAnchor;
  using enum DecalTurn;
  using world::PropKind;
  constexpr std::uint8_t kHard = kPaved | kRoad;
  constexpr std::uint8_t kSoft = kGreen | kBare;
  static constexpr std::array kRules = {
      DecalRule{patch, area, kRoad, 0.9, {0.6, 2.6}, {0.25, 0.7}, along, 0, 5},
      DecalRule{patch, area, kRoad, 0.2, {1.2, 2.6}, {0.12, 0.2}, across, 0, 6},
      DecalRule{slabs, area, kPaved, 0.6, {0.9, 3.0}, {0.3, 0.9}, along, 0, 5},
      DecalRule{tracks, area, kRoad, 0, {0, 0}, {1, 1}, along},
      DecalRule{tires, area, kRoad, 0.4, {2.0, 6.0}, {0.12, 0.3}, along, 0, 4},
      DecalRule{stain, area, kHard, 1.4, {0.3, 1.4}, {0.5, 1}},
      DecalRule{stain, area, kHard, 1.6, {0.1, 0.35}, {0.5, 1}},
      DecalRule{stain, area, kBare, 0.6, {0.6, 2.2}, {0.5, 1}},
      DecalRule{stain, wall, kHard, 1.2, {0.4, 1.4}, {0.3, 0.6}, along},
      DecalRule{stain, prop, kHard, 2, {0.4, 1.0}, {0.6, 0.9}, any, -1, 0, PropKind::car},
      DecalRule{stain, prop, kHard, 2, {0.3, 0.7}, {0.5, 1}, any, 0.3, 0, PropKind::bin},
      DecalRule{stain, prop, kHard, 3, {0.3, 0.9}, {0.5, 1}, any, 0.8, 0, PropKind::kiosk},
      DecalRule{stain, prop, kHard, 3, {0.3, 0.8}, {0.5, 1}, any, 0.8, 0, PropKind::stall},
      DecalRule{soil, area, kGreen, 0.25, {0.6, 1.6}, {0.5, 1}},
      DecalRule{soil, prop, kGreen, 2, {0.7, 1.2}, {0.5, 0.8}, any, 0.2, 0, PropKind::bench},
      DecalRule{soil, prop, kGreen, 4, {1.0, 1.8}, {0.6, 1}, any, 0.8, 0, PropKind::kiosk},
      DecalRule{soil, prop, kGreen, 4, {1.0, 1.8}, {0.6, 1}, any, 0.8, 0, PropKind::stall},
      DecalRule{soil, prop, kGreen, 4, {1.0, 2.0}, {0.6, 1}, any, 0.5, 0, PropKind::tent},
      DecalRule{wet, prop, kHard, 7, {0.7, 1.8}, {0.5, 0.9}, any, 0.1, 0, PropKind::fountain},
      DecalRule{wet, kerb, kRoad, 0.12, {0.6, 1.6}, {0.25, 0.4}, along},
      DecalRule{manhole, area, kPaved, 0.3, {0.33, 0.33}, {1, 1}, along, 0, 14},
      DecalRule{manhole, area, kRoad, 0.6, {0.33, 0.33}, {1, 1}, along, 0, 14},
      DecalRule{drain, area, kPaved, 0.25, {0.25, 0.25}, {0.6, 0.6}, along, 0, 11},
      DecalRule{drain, kerb, kRoad, 0.8, {0.25, 0.25}, {0.6, 0.6}, along, 0, 10},
      DecalRule{chalk, area, kPaved, 0.05, {1.5, 1.9}, {0.4, 0.4}, any, 0, 28},
      DecalRule{signs, area, kHard, 0.12, {0.3, 0.5}, {0.6, 0.9}, any, 0, 12},
      DecalRule{gum, area, kPaved, 1.4, {0.8, 1.5}, {0.6, 1}},
      DecalRule{gum, prop, kPaved, 2, {0.8, 1.4}, {0.6, 1}, any, 0.4, 0, PropKind::bench},
      DecalRule{gum, prop, kPaved, 3, {0.8, 1.6}, {0.6, 1}, any, 0.9, 0, PropKind::kiosk},
      DecalRule{daisies, area, kGreen, 0.9, {0.9, 2.0}, {0.5, 1}},
      DecalRule{weeds, wall, kPaved, 1.2, {0.3, 1.1}, {0.12, 0.3}, along},
      DecalRule{weeds, prop, kPaved, 1, {0.2, 0.3}, {0.7, 1}, any, 0, 0, PropKind::lamp_post},
      DecalRule{leaves, area, kSoft, 0.3, {0.8, 1.8}, {0.5, 1}},
      DecalRule{leaves, wall, kPaved, 0.7, {0.5, 1.8}, {0.15, 0.35}, along},
      DecalRule{leaves, kerb, kRoad, 1.5, {0.6, 2.2}, {0.1, 0.25}, along},
      DecalRule{leaves, prop, kAnyGround, 4, {1.0, 2.0}, {0.6, 1}, any, 2.0, 0, PropKind::tree},
      DecalRule{leaves, prop, kAnyGround, 1, {0.5, 0.9}, {0.6, 1}, any, 0.3, 0, PropKind::bush},
      DecalRule{litter, area, kHard, 0.35, {0.6, 1.4}, {0.6, 1}},
      DecalRule{litter, area, kSoft, 0.3, {0.6, 1.4}, {0.6, 1}},
      DecalRule{litter, wall, kPaved, 0.4, {0.5, 1.3}, {0.2, 0.4}, along},
      DecalRule{litter, kerb, kRoad, 0.4, {0.5, 1.3}, {0.2, 0.3}, along},
      DecalRule{litter, prop, kAnyGround, 2, {0.5, 0.9}, {0.7, 1}, any, 0.5, 0, PropKind::bin},
      DecalRule{litter, prop, kAnyGround, 1, {0.5, 1.0}, {0.6, 1}, any, 0.6, 0, PropKind::bench},
      DecalRule{litter, prop, kAnyGround, 2, {0.6, 1.2}, {0.6, 1}, any, 1.2, 0, PropKind::kiosk},
      DecalRule{litter, prop, kAnyGround, 2, {0.6, 1.2}, {0.6, 1}, any, 1.0, 0, PropKind::stall},
      DecalRule{litter, prop, kAnyGround, 9, {0.9, 1.6}, {0.6, 1}, any, 6.0, 0, PropKind::stage},
  };
  return kRules;
}

}  // namespace throng::render
