#include "skinning/wardrobe/outfit.h"

#include <algorithm>

#include "skinning/items.h"
#include "skinning/wardrobe/colors.h"
#include "skinning/wardrobe/garments.h"

namespace throng::skinning {

namespace {

constexpr double kChildUntil = 16;  // years

// Few colors per person and kind leave room for differences between people.
constexpr std::size_t kColors = 12;

template <typename T>
T pick(Random& random, const std::vector<T>& choices) {
  return choices[random.below(static_cast<std::uint32_t>(choices.size()))];
}

class Stylist {
 public:
  Stylist(const Wearer& wearer, bool with_attribution, Random& random)
      : wearer_(wearer), with_attribution_(with_attribution), random_(random) {}

  Outfit dress() {
    pick_clothes();
    pick_shoes();
    pick_hair();
    pick_carried();
    pick_colors();
    return std::move(outfit_);
  }

 private:
  bool child() const { return wearer_.age_years < kChildUntil; }
  bool formal() const {
    return outfit_.top == "male_elegantsuit01" || outfit_.bottom == "female_elegantsuit01";
  }
  bool chance(double share) { return random_.uniform() < share; }

  bool suits(const GarmentInfo& info) const {
    if (!with_attribution_ && info.license != License::cc0) return false;
    if (child() && !info.wearers.children) return false;
    if (wearer_.age_years > 40 && info.name == "female_casualsuit02" && info.slot == Slot::bottom) {
      return false;
    }
    // Children of one sex wear what the grown-ups of that sex wear.
    return wearer_.male ? info.wearers.men : info.wearers.women;
  }

  // One of the garments for a slot; `high` asks for bottoms that reach the waist.
  const GarmentInfo* draw_from(Slot slot, bool high = false) {
    std::vector<const GarmentInfo*> choices;
    for (const GarmentInfo& info : all_garments()) {
      if (info.slot == slot && suits(info) && (!high || info.high)) choices.push_back(&info);
    }
    if (choices.empty()) return nullptr;
    const GarmentInfo* choice = pick(random_, choices);
    while (!chance(choice->share)) choice = pick(random_, choices);
    return choice;
  }

  void pick_clothes() {
    const bool works = wearer_.age_years >= 18 && wearer_.age_years < 67;
    const double whole = wearer_.male && works ? 0.12 : 0;
    const double dress = wearer_.male ? 0 : 0.22;
    const double draw = random_.uniform();
    if (draw < whole) return wear_whole(draw_from(Slot::whole));
    if (draw < dress) return wear_dress();
    const GarmentInfo* top = draw_from(Slot::top);
    // Most women wear what is cut for them.
    if (!wearer_.male && top->wearers.men && chance(0.6)) top = draw_from(Slot::top);
    outfit_.top = top->name;
    outfit_.top_cloth = top_cloth(*top);
    wear_bottom(*draw_from(Slot::bottom, top->high));
  }

  void wear_whole(const GarmentInfo* suit) {
    outfit_.top = outfit_.bottom = suit->name;
    outfit_.one_piece = true;
    // Dark cloth with a white shirt and a tie cannot be separated by brightness alone: the suit
    // keeps its colors, and its tints are faint.
    outfit_.top_cloth = suit->name == "male_elegantsuit01" ? Cloth::own : Cloth::plain;
    outfit_.bottom_cloth = outfit_.top_cloth;
  }

  void wear_dress() {
    const GarmentInfo* ready_made = draw_from(Slot::dress);
    const double wear_share = ready_made == nullptr ? 0 : 0.6;
    outfit_.one_piece = true;
    outfit_.top_cloth = chance(0.25) ? Cloth::stripes : Cloth::plain;
    if (chance(wear_share)) {
      outfit_.top = ready_made->name;
      return;
    }
    outfit_.top = pick<std::string>(random_, {"female_casualsuit01", "female_casualsuit02"});
    outfit_.bottom = kSkirt;
    outfit_.bottom_cloth = outfit_.top_cloth;
    outfit_.hem = chance(0.6) ? Hem::knee : Hem::calf;
  }

  Cloth top_cloth(const GarmentInfo& top) {
    const bool shirt = top.name == "male_casualsuit03" || top.name == "female_elegantsuit01";
    const double draw = random_.uniform();
    if (shirt) return draw < 0.3 ? Cloth::checks : draw < 0.5 ? Cloth::print : Cloth::plain;
    if (top.name == "male_casualsuit05") return draw < 0.25 ? Cloth::checks : Cloth::plain;
    if (draw < 0.14) return Cloth::stripes;
    if (draw < 0.24) return Cloth::band;
    if (draw < 0.28) return Cloth::checks;
    return Cloth::plain;
  }

  void wear_bottom(const GarmentInfo& bottom) {
    outfit_.bottom = bottom.name;
    const bool trousers = bottom.label == "trousers";
    if (bottom.name == kSkirt) {
      outfit_.hem = chance(0.6) ? Hem::knee : Hem::calf;
      outfit_.bottom_cloth = chance(0.15) ? Cloth::checks : Cloth::plain;
      return;
    }
    const double shorts = child() ? 0.35 : wearer_.age_years > 65 ? 0.03 : 0.14;
    if (trousers && chance(shorts)) outfit_.hem = Hem::knee;
    const bool jeans = bottom.label == "jeans" || bottom.label == "hot pants" ||
                       (trousers && chance(wearer_.age_years > 60 ? 0.25 : 0.6));
    outfit_.bottom_cloth = jeans ? Cloth::print : Cloth::plain;
  }

  void pick_shoes() {
    outfit_.shoes = draw_from(Slot::shoes)->name;
    const bool skirt = outfit_.bottom.empty() || outfit_.bottom == kSkirt;
    if (formal() || (skirt && chance(0.75))) {
      outfit_.shoes = pick<std::string>(random_, {"shoes03", "shoes04", "shoes01"});
    } else if (outfit_.hem != Hem::foot && !skirt) {
      outfit_.shoes = pick<std::string>(random_, {"shoes05", "shoes06", "shoes04"});
    }
  }

  // Without hair the skin's image shows; only these show no stubble of a color of its own.
  bool may_be_bald() const { return wearer_.curly || wearer_.age_years > 58; }

  void pick_hair() {
    std::string& hair = outfit_.hair;
    outfit_.hair_cut = random_.uniform(0.2, 1);
    if (wearer_.male) {
      hair = wearer_.curly
                 ? pick<std::string>(random_, {"afro01", "short04", "short02", ""})
                 : pick<std::string>(random_, {"short02", "short03", "short04", "short01"});
      if (wearer_.age_years > 45 && chance(0.4)) hair.clear();
      if (hair.empty() && (child() || !may_be_bald())) hair = "short04";
    } else {
      hair = wearer_.curly
                 ? pick<std::string>(random_, {"afro01", "ponytail01", "bob02", "Braid01"})
                 : pick<std::string>(
                       random_, {"bob02", "ponytail01", "long01", "long01", "Braid01", "short03"});
      if (wearer_.age_years > 60)
        hair = pick<std::string>(random_, {"bob02", "short03", "short02", "ponytail01"});
    }
    const double hats = child() ? 0.02 : wearer_.age_years > 60 ? 0.12 : 0.06;
    if (!chance(hats)) return;
    const GarmentInfo* hat = draw_from(Slot::hat);
    if (hat == nullptr) return;
    outfit_.hat = hat->name;
    // Hair that stands far off the head would come through the hat.
    if (hair == "afro01" || hair == "short01") hair = "short04";
  }

  void pick_carried() {
    const double age = wearer_.age_years;
    const double draw = random_.uniform();
    struct Share {
      Carry carry;
      double share;
    };
    const double women = wearer_.male ? 0 : 1;
    const std::vector<Share> shares =
        child() ? std::vector<Share>{{Carry::backpack, 0.3}}
                : std::vector<Share>{{Carry::backpack, age < 70 ? 0.15 : 0},
                                     {Carry::shoulder_bag, 0.08 + 0.05 * women},
                                     {Carry::handbag, 0.02 + 0.14 * women},
                                     {Carry::umbrella, 0.18},
                                     {Carry::walking_stick, age < 70 ? 0 : 0.2},
                                     {Carry::suitcase, age < 75 ? 0.05 : 0},
                                     {Carry::pram, age < 45 ? 0.02 + 0.03 * women : 0},
                                     {Carry::bicycle, age < 70 ? 0.04 : 0}};
    double sum = 0;
    for (const Share& share : shares) {
      sum += share.share;
      if (draw >= sum) continue;
      outfit_.carries = share.carry;
      return;
    }
  }

  void set_colors(Tint tint, std::vector<Rgb> colors) {
    outfit_.tints[static_cast<std::size_t>(tint)] = std::move(colors);
  }

  void pick_colors() {
    const bool overall = outfit_.top == "male_worksuit01";
    const bool suit = outfit_.top_cloth == Cloth::own;
    const Dye top = suit                ? Dye::suit
                    : overall           ? Dye::workwear
                    : outfit_.one_piece ? Dye::dress
                                        : Dye::shirt;
    set_colors(Tint::top, draw_colors(top, kColors, random_));
    const bool skirt = outfit_.bottom == kSkirt || outfit_.bottom == "female_elegantsuit01";
    const Dye bottom = skirt                                  ? Dye::skirt
                       : outfit_.bottom_cloth == Cloth::print ? Dye::denim
                                                              : Dye::trousers;
    set_colors(Tint::bottom, draw_colors(bottom, kColors, random_));
    const bool trainers = garment(outfit_.shoes, Slot::shoes).label == "trainers";
    set_colors(Tint::shoes, draw_colors(trainers ? Dye::trainers : Dye::leather, kColors, random_));
    const bool bright = outfit_.carries == Carry::umbrella || outfit_.carries == Carry::bicycle;
    const Dye item = bright                                    ? Dye::umbrella
                     : outfit_.carries == Carry::walking_stick ? Dye::leather
                                                               : Dye::bag;
    if (outfit_.carries != Carry::nothing) {
      set_colors(Tint::item, draw_colors(item, kColors, random_));
    }
    HairRange range = wearer_.dark_hair ? HairRange::dark : HairRange::any;
    if (wearer_.age_years > 48) range = HairRange::graying;
    if (wearer_.age_years > 62) range = HairRange::gray;
    constexpr std::size_t kHairColors = 5;
    set_colors(Tint::hair, draw_hair(range, kHairColors, random_));
  }

  const Wearer& wearer_;
  bool with_attribution_;
  Random& random_;
  Outfit outfit_;
};

}  // namespace

Outfit sample_outfit(const Wearer& wearer, bool with_attribution, Random& random) {
  return Stylist(wearer, with_attribution, random).dress();
}

std::string describe_outfit(const Outfit& outfit) {
  std::string text;
  const auto add = [&](std::string_view label) {
    if (!text.empty()) text += ", ";
    text += label;
  };
  if (outfit.bottom.empty()) {
    add(garment(outfit.top, Slot::dress).label);
  } else if (outfit.top == outfit.bottom && outfit.one_piece) {
    add(garment(outfit.top, Slot::whole).label);
  } else if (outfit.one_piece) {
    add("dress");
  } else {
    add(garment(outfit.top, Slot::top).label);
    const std::string_view bottom = garment(outfit.bottom, Slot::bottom).label;
    const bool denim = outfit.bottom_cloth == Cloth::print && bottom == "trousers";
    const bool shorts = outfit.hem == Hem::knee && bottom == "trousers";
    add(shorts ? "shorts" : denim ? "jeans" : bottom);
  }
  add(garment(outfit.shoes, Slot::shoes).label);
  if (!outfit.hat.empty()) add(garment(outfit.hat, Slot::hat).label);
  return text;
}

}  // namespace throng::skinning
