// Words of shop signs as sprites beside those of leaves (leaf_sprites.h): sheets of four words one
// above the other.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/props/leaf_sprites.h"

namespace throng::render {

inline constexpr int kWordsPerSheet = 4;
inline constexpr double kLetterAspect = kWordsPerSheet;  ///< width of a word's card by its height

inline constexpr std::array<std::string_view, 24> kShopWords = {
    "BAKERY",  "CAFE",  "PHARMACY",  "BOOKS",   "FLOWERS", "SHOES",   "OPTICIAN", "BICYCLES",
    "BARBER",  "PIZZA", "TAVERN",    "FASHION", "TOYS",    "JEWELER", "HOTEL",    "BANK",
    "GROCERY", "PHOTO", "TEA HOUSE", "WINES",   "RECORDS", "TAILOR",  "HARDWARE", "ICE CREAM"};

inline constexpr int kLetterSheets =
    (static_cast<int>(kShopWords.size()) + kWordsPerSheet - 1) / kWordsPerSheet;

/// A sheet's levels, as draw_leaf_sprite().
std::vector<std::vector<LeafTexel>> draw_letter_sheet(int sheet);

}  // namespace throng::render
