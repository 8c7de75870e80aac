// The garments of the package, and their licenses.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace throng::skinning {

/// Licenses of assets. CC0 has no conditions; the others require the author's name in the notice.
enum class License : std::uint8_t { cc0, cc_by_3, cc_by_4 };

std::string_view spdx_name(License license);

/// The part of a person that a garment covers. Most suits of the package have a top and a bottom
/// that can be worn separately, with an entry for each.
enum class Slot : std::uint8_t { top, bottom, whole, dress, shoes, hat, hair };

/// The people whom a garment suits.
struct Wearers {
  bool men = true;
  bool women = true;
  bool children = true;
};

/// An entry of the list of garments.
struct GarmentInfo {
  std::string_view name;   ///< folder in the package, or kSkirt
  std::string_view label;  ///< word in descriptions
  Slot slot;
  License license;
  Wearers wearers;
  /// A top that ends at the waist, or a bottom that reaches up to it, which such tops require.
  bool high = false;
  /// Acceptance rate of a sample.
  double share = 1;
};

/// The name of a skirt that is cut from the base mesh's helper skirt (wardrobe/skirt.h).
inline constexpr std::string_view kSkirt = "helper-skirt";

/// All garments.
std::span<const GarmentInfo> all_garments();

/// The entry of a garment in a slot, which must exist.
const GarmentInfo& garment(std::string_view name, Slot slot);

/// The license of a proxy (clothes, hair, eyes or eyebrows), which must be in the list.
License find_license(std::string_view name);

}  // namespace throng::skinning
