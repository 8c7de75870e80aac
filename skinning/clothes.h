// Garments that a character wears, read from its description in words.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace throng::skinning {

/// A garment's place on the body; `whole` covers the upper and the lower body.
enum class ClothesSlot : std::uint8_t { upper, lower, whole, shoes, hat };
std::string_view to_string(ClothesSlot slot);

struct Clothing {
  ClothesSlot slot;
  std::string_view type;  ///< as in `Character::wears`, e.g. "t-shirt"
};

/// The garments of the library in a description such as "t-shirt, jeans, trainers", in its order.
/// Words that the library does not know, which imported characters may have, are left out. The
/// types are valid as long as the program runs.
std::vector<Clothing> clothes_in(std::string_view wears);

}  // namespace throng::skinning
