#include "skinning/wardrobe/clothes.h"

#include <array>
#include <optional>

#include "skinning/wardrobe/garments.h"

namespace throng::skinning {

namespace {

std::optional<ClothesSlot> clothes_slot(Slot slot) {
  switch (slot) {
    case Slot::top:
      return ClothesSlot::upper;
    case Slot::bottom:
      return ClothesSlot::lower;
    case Slot::whole:
    case Slot::dress:
      return ClothesSlot::whole;
    case Slot::shoes:
      return ClothesSlot::shoes;
    case Slot::hat:
      return ClothesSlot::hat;
    case Slot::hair:
      break;
  }
  return std::nullopt;
}

/// Descriptions call trousers by their hem and cloth, and a dress of two pieces a dress, and tops
/// by their pattern, whatever garments the package has (describe_outfit() in wardrobe/outfit.h).
constexpr std::array kDescribed = {Clothing{ClothesSlot::lower, "shorts"},
                                   Clothing{ClothesSlot::lower, "jeans"},
                                   Clothing{ClothesSlot::whole, "dress"},
                                   Clothing{ClothesSlot::upper, "coat"},
                                   Clothing{ClothesSlot::upper, "jacket"},
                                   Clothing{ClothesSlot::upper, "padded jacket"},
                                   Clothing{ClothesSlot::upper, "hoodie"},
                                   Clothing{ClothesSlot::upper, "sports shirt"},
                                   Clothing{ClothesSlot::upper, "high-visibility vest"}};

std::optional<Clothing> clothing_named(std::string_view word) {
  for (const Clothing& described : kDescribed) {
    if (described.type == word) return described;
  }
  for (const GarmentInfo& info : all_garments()) {
    const std::optional<ClothesSlot> slot = clothes_slot(info.slot);
    if (slot && info.label == word) return Clothing{*slot, info.label};
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(ClothesSlot slot) {
  constexpr std::array<std::string_view, 5> kNames = {"upper", "lower", "whole", "shoes", "hat"};
  return kNames.at(static_cast<std::size_t>(slot));
}

std::vector<Clothing> clothes_in(std::string_view wears) {
  constexpr std::string_view kBetween = ", ";
  std::vector<Clothing> clothes;
  while (!wears.empty()) {
    const std::size_t end = wears.find(kBetween);
    if (const auto clothing = clothing_named(wears.substr(0, end))) clothes.push_back(*clothing);
    wears = end == std::string_view::npos ? "" : wears.substr(end + kBetween.size());
  }
  return clothes;
}

}  // namespace throng::skinning
