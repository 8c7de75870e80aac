#include "skinning/wardrobe/garments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"
#include "skinning/wardrobe/headwear.h"

namespace throng::skinning {

namespace {

using enum Slot;
using enum License;

constexpr Wearers kAll{};
constexpr Wearers kAdults{true, true, false};
constexpr Wearers kMen{true, false, false};
constexpr Wearers kWomen{false, true, false};
constexpr Wearers kGirlsToo{false, true, true};
constexpr Wearers kBoysToo{true, false, true};

// The CC0 part follows the owners' release of September 2020 (its address is in NOTICE.txt); the
// rest carries its author's CC BY in the package itself.
constexpr std::array kGarments = {
    GarmentInfo{"male_casualsuit02", "long-sleeved shirt", top, cc0, kAll, true},
    GarmentInfo{"male_casualsuit03", "shirt", top, cc0, kAll, true},
    GarmentInfo{"male_casualsuit04", "t-shirt", top, cc0, kAll, true},
    GarmentInfo{"male_casualsuit05", "shirt and vest", top, cc0, kAdults, true, 0.5},
    GarmentInfo{"male_casualsuit06", "t-shirt", top, cc0, kAll, true},
    GarmentInfo{"female_casualsuit01", "t-shirt", top, cc0, kGirlsToo},
    GarmentInfo{"female_casualsuit02", "t-shirt", top, cc0, kGirlsToo},
    GarmentInfo{"female_elegantsuit01", "blouse", top, cc0, kWomen},
    GarmentInfo{"male_casualsuit02", "trousers", bottom, cc0, kAll, true},
    GarmentInfo{"male_casualsuit03", "trousers", bottom, cc0, kAll, true},
    GarmentInfo{"male_casualsuit04", "trousers", bottom, cc0, kAll, true},
    GarmentInfo{"male_casualsuit05", "trousers", bottom, cc0, kAll, true},
    GarmentInfo{"male_casualsuit06", "trousers", bottom, cc0, kAll, true},
    GarmentInfo{"female_casualsuit01", "trousers", bottom, cc0, kGirlsToo},
    GarmentInfo{"female_casualsuit02", "hot pants", bottom, cc0, kWomen, false, 0.3},
    GarmentInfo{"female_elegantsuit01", "straight skirt", bottom, cc0, kWomen},
    GarmentInfo{"female_sportsuit01", "sports trousers", bottom, cc0, kGirlsToo},
    GarmentInfo{kSkirt, "skirt", bottom, cc0, kGirlsToo, true},
    GarmentInfo{"male_elegantsuit01", "suit and tie", whole, cc0, kMen},
    GarmentInfo{"male_worksuit01", "overall", whole, cc0, kMen},
    GarmentInfo{"shoes01", "leather shoes", shoes, cc0, kAdults},
    GarmentInfo{"shoes02", "boots", shoes, cc0, kAll},
    GarmentInfo{"shoes03", "leather shoes", shoes, cc0, kAdults},
    GarmentInfo{"shoes04", "leather shoes", shoes, cc0, kAll},
    GarmentInfo{"shoes05", "trainers", shoes, cc0, kAll},
    GarmentInfo{"shoes06", "trainers", shoes, cc0, kAll},
    GarmentInfo{"fedora", "hat", hat, cc0, kAdults},
    GarmentInfo{"fedora_cocked", "hat", hat, cc0, kMen},
    GarmentInfo{kCap, "cap", hat, cc0, kAll},
    GarmentInfo{kKnittedHat, "knitted hat", hat, cc0, kAll},
    GarmentInfo{kHeadscarf, "headscarf", hat, cc0, kWomen},
    GarmentInfo{kScarf, "", hair, cc0, kAll},
    GarmentInfo{kBeard, "", hair, cc0, kMen},
    GarmentInfo{kMoustache, "", hair, cc0, kMen},
    GarmentInfo{kCropped, "", hair, cc0, kMen},
    GarmentInfo{kReceding, "", hair, cc0, kMen},
    GarmentInfo{"afro01", "", hair, cc0, kAll},
    GarmentInfo{"bob02", "", hair, cc0, kGirlsToo},
    GarmentInfo{"Braid01", "", hair, cc0, kGirlsToo},
    GarmentInfo{"long01", "", hair, cc0, kGirlsToo},
    GarmentInfo{"ponytail01", "", hair, cc0, kGirlsToo},
    GarmentInfo{"short01", "", hair, cc0, kBoysToo},
    GarmentInfo{"short02", "", hair, cc0, kAll},
    GarmentInfo{"short03", "", hair, cc0, kAll},
    GarmentInfo{"short04", "", hair, cc0, kAll},

    GarmentInfo{"VNeckTop", "v-neck top", top, cc_by_3, kWomen, true},
    GarmentInfo{"Sleeveless", "sleeveless blouse", top, cc_by_3, kWomen, true},
    GarmentInfo{"spaghetti-top", "strap top", top, cc_by_3, kWomen, true, 0.5},
    GarmentInfo{"Tank_Top_01", "tank top", top, cc_by_4, kWomen, true, 0.5},
    GarmentInfo{"Tightjeans", "jeans", bottom, cc_by_3, kWomen},
    GarmentInfo{"F_Dress_01", "dress", dress, cc_by_4, kWomen},
    GarmentInfo{"F_Dress_02", "dress", dress, cc_by_4, kWomen},
    GarmentInfo{"TubeDress", "dress", dress, cc_by_3, kWomen, false, 0.4},
    GarmentInfo{"WinterBoots", "winter boots", shoes, cc_by_3, kWomen, false, 0.5},
    GarmentInfo{"Fishing_Hat_01", "fishing hat", hat, cc_by_4, kAll},
};

bool is_face(std::string_view name) {
  if (name == "Low-Poly") return true;
  if (!name.starts_with("eyebrow") || name.size() != 10) return false;
  return name >= "eyebrow001" && name <= "eyebrow012";
}

}  // namespace

std::string_view spdx_name(License license) {
  switch (license) {
    case cc_by_3:
      return "CC-BY-3.0";
    case cc_by_4:
      return "CC-BY-4.0";
    case cc0:
      break;
  }
  return "CC0-1.0";
}

std::span<const GarmentInfo> all_garments() { return kGarments; }

const GarmentInfo& garment(std::string_view name, Slot slot) {
  const auto* const found =
      std::find_if(kGarments.begin(), kGarments.end(),
                   [&](const GarmentInfo& info) { return info.name == name && info.slot == slot; });
  check(found != kGarments.end(), "only garments of the list are worn");
  return *found;
}

License find_license(std::string_view name) {
  if (is_face(name)) return cc0;
  const auto* const found =
      std::find_if(kGarments.begin(), kGarments.end(),
                   [&](const GarmentInfo& info) { return info.name == name; });
  check(found != kGarments.end(), "only garments of the list are worn");
  return found->license;
}

}  // namespace throng::skinning
