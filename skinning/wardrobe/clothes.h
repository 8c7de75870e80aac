// The garments of a character, from its textual description.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace throng::skinning {

/// The part of the body that a garment covers; `whole` is the upper and the lower body.
enum class ClothesSlot : std::uint8_t { upper, lower, whole, shoes, hat };
std::string_view to_string(ClothesSlot slot);

/// A garment in a description.
struct Clothing {
  ClothesSlot slot;
  std::string_view type;  ///< word in Character::wears, such as "t-shirt"
};

/// The garments in a description such as "t-shirt, jeans, trainers", in its order. Unknown words,
/// which imported characters may have, are omitted. The `type` views have static lifetime.
std::vector<Clothing> clothes_in(std::string_view wears);

}  // namespace throng::skinning
