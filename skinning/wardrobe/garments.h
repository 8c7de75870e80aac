// Garments of the package, and their licenses.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace throng::skinning {

/// The owners' terms. CC0 needs nothing; the others need the author's name in the NOTICE.
enum class License : std::uint8_t { cc0, cc_by_3, cc_by_4 };

std::string_view spdx_name(License license);

/// How much of a person a garment dresses. Most suits of the package are a top and a bottom that
/// are worn apart, with one entry for each.
enum class Slot : std::uint8_t { top, bottom, whole, dress, shoes, hat, hair };

/// Wearers that a garment suits.
struct Wearers {
  bool men = true;
  bool women = true;
  bool children = true;
};

struct GarmentInfo {
  std::string_view name;   ///< folder in the package, or of our own making (see kSkirt)
  std::string_view label;  ///< for people
  Slot slot;
  License license;
  Wearers wearers;
  /// Tops that end at the waist need bottoms that reach up to it.
  bool high = false;
  /// Acceptance rate of a sample.
  double share = 1;
};

/// A skirt cut from the base mesh's own helper skirt, down to one of kSkirtHems.
inline constexpr std::string_view kSkirt = "helper-skirt";

/// Everything that may be worn.
std::span<const GarmentInfo> all_garments();

/// The entry of a garment in a slot. Throws when there is none: what is not in the list is not
/// worn.
const GarmentInfo& garment(std::string_view name, Slot slot);

/// The terms of a proxy (clothes, hair, eyes or eyebrows). Throws when it is not in the list.
License find_license(std::string_view name);

}  // namespace throng::skinning
