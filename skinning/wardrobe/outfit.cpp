#include "skinning/wardrobe/outfit.h"

#include <algorithm>
#include <array>

#include "skinning/items.h"
#include "skinning/wardrobe/colors.h"
#include "skinning/wardrobe/garments.h"
#include "skinning/wardrobe/headwear.h"
#include "skinning/wardrobe/pattern.h"

namespace throng::skinning {

namespace {

constexpr double kChildUntil = 16;  // years

// Few colors per person and kind leave room for differences between people.
constexpr std::size_t kColors = 12;

template <typename T>
T pick(Random& random, const std::vector<T>& choices) {
  return choices[random.below(static_cast<std::uint32_t>(choices.size()))];
}

// Jackets and coats are cut from it.
constexpr std::string_view kLongSleeved = "male_casualsuit02";

bool is_two_colored(Cloth cloth) {
  return cloth == Cloth::halves || cloth == Cloth::sleeves || cloth == Cloth::yoke ||
         cloth == Cloth::words || cloth == Cloth::dots;
}

std::string_view top_label(const Outfit& outfit) {
  if (outfit.coat > 0) return "coat";
  switch (outfit.top_cloth) {
    case Cloth::zip:
    case Cloth::buttons:
      return "jacket";
    case Cloth::quilt:
      return "padded jacket";
    case Cloth::hoodie:
      return "hoodie";
    case Cloth::vest:
      return "high-visibility vest";
    case Cloth::yoke:
      return outfit.top == kLongSleeved ? "jacket" : "sports shirt";
    case Cloth::halves:
    case Cloth::sleeves:
      return "sports shirt";
    default:
      return garment(outfit.top, Slot::top).label;
  }
}

class Stylist {
 public:
  Stylist(const Wearer& wearer, bool with_attribution, Random& random)
      : wearer_(wearer), with_attribution_(with_attribution), random_(random) {}

  Outfit dress() {
    pick_clothes();
    pick_shoes();
    pick_hair();
    pick_beard();
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
    if (chance(0.34)) return wear_outerwear();
    const GarmentInfo* top = draw_from(Slot::top);
    // Most women wear what is cut for them.
    if (!wearer_.male && top->wearers.men && chance(0.6)) top = draw_from(Slot::top);
    outfit_.top = top->name;
    outfit_.top_cloth = top_cloth(*top);
    if (is_two_colored(outfit_.top_cloth)) outfit_.accent = draw_accent();
    wear_bottom(*draw_from(Slot::bottom, top->high));
  }

  void wear_outerwear() {
    outfit_.top = kLongSleeved;
    const bool works = wearer_.age_years >= 18 && wearer_.age_years < 65;
    const double draw = random_.uniform();
    if (works && draw < 0.07) {
      outfit_.top_cloth = Cloth::vest;
      outfit_.accent = pick<Rgb>(random_, {{70, 78, 110}, {84, 84, 84}, {196, 120, 70}});
    } else if (wearer_.age_years < 45 && draw < 0.28) {
      outfit_.top_cloth = Cloth::hoodie;
    } else {
      outfit_.top_cloth = pick<Cloth>(random_, {Cloth::zip, Cloth::quilt, Cloth::buttons,
                                                Cloth::yoke, Cloth::zip, Cloth::quilt});
      if (child() && outfit_.top_cloth == Cloth::buttons) outfit_.top_cloth = Cloth::yoke;
      if (outfit_.top_cloth == Cloth::yoke) outfit_.accent = draw_accent();
      const double coats = child() ? 0.15 : wearer_.male ? 0.35 : 0.5;
      const bool may_be_coat = outfit_.top_cloth != Cloth::yoke;
      if (may_be_coat && chance(coats)) outfit_.coat = random_.uniform(0.35, child() ? 0.6 : 0.9);
      outfit_.scarf = chance(outfit_.coat > 0 ? 0.4 : 0.15);
    }
    const GarmentInfo* bottom = draw_from(Slot::bottom, true);
    while (outfit_.coat > 0 && bottom->name == kSkirt) bottom = draw_from(Slot::bottom, true);
    wear_bottom(*bottom);
    if (outfit_.coat > 0 || outfit_.top_cloth == Cloth::quilt) {
      if (outfit_.bottom != kSkirt) outfit_.hem = Hem::foot;
    }
  }

  Rgb draw_accent() {
    return pick<Rgb>(random_, {{70, 78, 110},
                               {90, 90, 94},
                               {168, 62, 60},
                               {80, 110, 170},
                               {86, 124, 92},
                               {150, 150, 154},
                               {190, 130, 70}});
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
    if (top.name == "male_casualsuit05") {
      return draw < 0.25 ? Cloth::checks : draw < 0.45 ? Cloth::pinstripes : Cloth::plain;
    }
    constexpr double kShare = 0.07;  // of each pattern
    constexpr std::array kPatterns = {Cloth::stripes, Cloth::words,  Cloth::stripes,
                                      Cloth::words,   Cloth::checks, Cloth::band};
    const auto at = static_cast<std::size_t>(draw / kShare);
    if (at < kPatterns.size()) return kPatterns[at];
    const bool with_sleeves = top.label == "t-shirt" || top.label == "long-sleeved shirt";
    if (draw < 0.5) return with_sleeves ? wear_sport() : Cloth::plain;
    if (draw < 0.55) return wearer_.male ? Cloth::camouflage : Cloth::dots;
    return draw < 0.6 && !wearer_.male ? Cloth::dots : Cloth::plain;
  }

  // Shirts of two colors, for those who may do sports.
  Cloth wear_sport() {
    if (wearer_.age_years > 55) return Cloth::plain;
    return pick<Cloth>(random_, {Cloth::halves, Cloth::sleeves, Cloth::sleeves, Cloth::yoke});
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
    if (jeans || outfit_.hem != Hem::foot) return;
    const bool sporty = bottom.label == "sports trousers" || wearer_.age_years < 40;
    if (sporty && chance(0.3)) outfit_.bottom_cloth = Cloth::side_stripes;
    if (wearer_.male && chance(0.08)) outfit_.bottom_cloth = Cloth::camouflage;
    if (!sporty && chance(0.15)) outfit_.bottom_cloth = Cloth::pinstripes;
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
      if (!child() && chance(0.2)) hair = kCropped;
      if (wearer_.age_years > 35 && chance(0.3)) hair = kReceding;
      if (wearer_.age_years > 45 && chance(0.25)) hair.clear();
      if (hair.empty() && (child() || !may_be_bald())) hair = kCropped;
    } else {
      hair = wearer_.curly
                 ? pick<std::string>(random_, {"afro01", "ponytail01", "bob02", "Braid01"})
                 : pick<std::string>(
                       random_, {"bob02", "ponytail01", "long01", "long01", "Braid01", "short03"});
      if (wearer_.age_years > 60)
        hair = pick<std::string>(random_, {"bob02", "short03", "short02", "ponytail01"});
    }
    const bool cold = outfit_.coat > 0 || outfit_.top_cloth == Cloth::quilt;
    const double hats = cold ? 0.35 : child() ? 0.12 : 0.14;
    if (!wearer_.male && !child() && chance(0.05)) {
      outfit_.hat = kHeadscarf;
      hair.clear();
      return;
    }
    if (!chance(hats)) return;
    const bool own = chance(0.75);
    if (own) {
      outfit_.hat = cold ? kKnittedHat : chance(0.75) ? kCap : kKnittedHat;
      if (hair == "afro01" || hair == "short01") hair = wearer_.male ? kCropped : "ponytail01";
      return;
    }
    const GarmentInfo* hat = draw_from(Slot::hat);
    if (hat == nullptr || is_made_here(hat->name)) return;
    outfit_.hat = hat->name;
    // Hair that stands far off the head would come through the hat.
    if (hair == "afro01" || hair == "short01") hair = "short04";
  }

  void pick_beard() {
    if (!wearer_.male || wearer_.age_years < 20) return;
    const double draw = random_.uniform();
    if (draw < 0.28) outfit_.beard = kBeard;
    if (draw > 0.94) outfit_.beard = kMoustache;
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
    const Cloth cloth = outfit_.top_cloth;
    const Dye top = suit                         ? Dye::suit
                    : cloth == Cloth::vest       ? Dye::reflective
                    : is_two_colored(cloth)      ? Dye::light
                    : is_outerwear(cloth)        ? Dye::coat
                    : cloth == Cloth::camouflage ? Dye::camouflage
                    : overall                    ? Dye::workwear
                    : outfit_.one_piece          ? Dye::dress
                                                 : Dye::shirt;
    set_colors(Tint::top, draw_colors(top, kColors, random_));
    const bool skirt = outfit_.bottom == kSkirt || outfit_.bottom == "female_elegantsuit01";
    const Dye bottom = skirt                                       ? Dye::skirt
                       : outfit_.bottom_cloth == Cloth::camouflage ? Dye::camouflage
                       : outfit_.bottom_cloth == Cloth::print      ? Dye::denim
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

bool is_outerwear(Cloth cloth) {
  switch (cloth) {
    case Cloth::zip:
    case Cloth::quilt:
    case Cloth::hoodie:
    case Cloth::buttons:
    case Cloth::vest:
      return true;
    default:
      return false;
  }
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
    add(top_label(outfit));
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
