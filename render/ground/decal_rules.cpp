#include "render/ground/decal_rules.h"

namespace throng::render {

std::span<const DecalRule> decal_rules() {
  using enum DecalKind;
  using enum DecalAnchor;
  using enum DecalTurn;
  using world::PropKind;
  constexpr std::uint8_t kHard = on_paved | on_road;
  constexpr std::uint8_t kSoft = on_green | on_bare;
  static constexpr std::array kRules = {
      DecalRule{patch, area, on_road, 0.9, {0.6, 2.6}, {0.25, 0.7}, along, 0, 5},
      DecalRule{patch, area, on_road, 0.2, {1.2, 2.6}, {0.12, 0.2}, across, 0, 6},
      DecalRule{slabs, area, on_paved, 0.6, {0.9, 3.0}, {0.3, 0.9}, along, 0, 5},
      DecalRule{tracks, area, on_road, 0, {0, 0}, {1, 1}, along},
      DecalRule{tires, area, on_road, 0.4, {2.0, 6.0}, {0.12, 0.3}, along, 0, 4},
      DecalRule{stain, area, kHard, 1.4, {0.3, 1.4}, {0.5, 1}},
      DecalRule{stain, area, kHard, 1.6, {0.1, 0.35}, {0.5, 1}},
      DecalRule{stain, area, on_bare, 0.6, {0.6, 2.2}, {0.5, 1}},
      DecalRule{stain, wall, kHard, 1.2, {0.4, 1.4}, {0.3, 0.6}, along},
      DecalRule{stain, prop, kHard, 2, {0.4, 1.0}, {0.6, 0.9}, any, -1, 0, PropKind::car},
      DecalRule{stain, prop, kHard, 2, {0.3, 0.7}, {0.5, 1}, any, 0.3, 0, PropKind::bin},
      DecalRule{stain, prop, kHard, 3, {0.3, 0.9}, {0.5, 1}, any, 0.8, 0, PropKind::kiosk},
      DecalRule{stain, prop, kHard, 3, {0.3, 0.8}, {0.5, 1}, any, 0.8, 0, PropKind::stall},
      DecalRule{soil, area, on_green, 0.25, {0.6, 1.6}, {0.5, 1}},
      DecalRule{soil, prop, on_green, 2, {0.7, 1.2}, {0.5, 0.8}, any, 0.2, 0, PropKind::bench},
      DecalRule{soil, prop, on_green, 4, {1.0, 1.8}, {0.6, 1}, any, 0.8, 0, PropKind::kiosk},
      DecalRule{soil, prop, on_green, 4, {1.0, 1.8}, {0.6, 1}, any, 0.8, 0, PropKind::stall},
      DecalRule{soil, prop, on_green, 4, {1.0, 2.0}, {0.6, 1}, any, 0.5, 0, PropKind::tent},
      DecalRule{wet, prop, kHard, 7, {0.7, 1.8}, {0.5, 0.9}, any, 0.1, 0, PropKind::fountain},
      DecalRule{wet, kerb, on_road, 0.12, {0.6, 1.6}, {0.25, 0.4}, along},
      DecalRule{manhole, area, on_paved, 0.3, {0.33, 0.33}, {1, 1}, along, 0, 14},
      DecalRule{manhole, area, on_road, 0.6, {0.33, 0.33}, {1, 1}, along, 0, 14},
      DecalRule{drain, area, on_paved, 0.25, {0.25, 0.25}, {0.6, 0.6}, along, 0, 11},
      DecalRule{drain, kerb, on_road, 0.8, {0.25, 0.25}, {0.6, 0.6}, along, 0, 10},
      DecalRule{chalk, area, on_paved, 0.05, {1.5, 1.9}, {0.4, 0.4}, any, 0, 28},
      DecalRule{signs, area, kHard, 0.12, {0.3, 0.5}, {0.6, 0.9}, any, 0, 12},
      DecalRule{gum, area, on_paved, 1.4, {0.8, 1.5}, {0.6, 1}},
      DecalRule{gum, prop, on_paved, 2, {0.8, 1.4}, {0.6, 1}, any, 0.4, 0, PropKind::bench},
      DecalRule{gum, prop, on_paved, 3, {0.8, 1.6}, {0.6, 1}, any, 0.9, 0, PropKind::kiosk},
      DecalRule{daisies, area, on_green, 0.9, {0.9, 2.0}, {0.5, 1}},
      DecalRule{weeds, wall, on_paved, 1.2, {0.3, 1.1}, {0.12, 0.3}, along},
      DecalRule{weeds, prop, on_paved, 1, {0.2, 0.3}, {0.7, 1}, any, 0, 0, PropKind::lamp_post},
      DecalRule{leaves, area, kSoft, 0.3, {0.8, 1.8}, {0.5, 1}},
      DecalRule{leaves, wall, on_paved, 0.7, {0.5, 1.8}, {0.15, 0.35}, along},
      DecalRule{leaves, kerb, on_road, 1.5, {0.6, 2.2}, {0.1, 0.25}, along},
      DecalRule{leaves, prop, on_any, 4, {1.0, 2.0}, {0.6, 1}, any, 2.0, 0, PropKind::tree},
      DecalRule{leaves, prop, on_any, 1, {0.5, 0.9}, {0.6, 1}, any, 0.3, 0, PropKind::bush},
      DecalRule{litter, area, kHard, 0.35, {0.6, 1.4}, {0.6, 1}},
      DecalRule{litter, area, kSoft, 0.3, {0.6, 1.4}, {0.6, 1}},
      DecalRule{litter, wall, on_paved, 0.4, {0.5, 1.3}, {0.2, 0.4}, along},
      DecalRule{litter, kerb, on_road, 0.4, {0.5, 1.3}, {0.2, 0.3}, along},
      DecalRule{litter, prop, on_any, 2, {0.5, 0.9}, {0.7, 1}, any, 0.5, 0, PropKind::bin},
      DecalRule{litter, prop, on_any, 1, {0.5, 1.0}, {0.6, 1}, any, 0.6, 0, PropKind::bench},
      DecalRule{litter, prop, on_any, 2, {0.6, 1.2}, {0.6, 1}, any, 1.2, 0, PropKind::kiosk},
      DecalRule{litter, prop, on_any, 2, {0.6, 1.2}, {0.6, 1}, any, 1.0, 0, PropKind::stall},
      DecalRule{litter, prop, on_any, 9, {0.9, 1.6}, {0.6, 1}, any, 6.0, 0, PropKind::stage},
  };
  return kRules;
}

}  // namespace throng::render
