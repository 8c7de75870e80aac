#include "skinning/wardrobe/colors.h"

#include <span>

namespace throng::skinning {

namespace {

struct Swatch {
  Rgb color;
  double weight;
};

// Black cloth reflects 3 to 5 %, so that its folds show.
// Streets are gray, black, white and navy, with some color: weights are our own estimate.
constexpr Swatch kShirt[] = {
    {{238, 238, 234}, 12}, {{222, 218, 208}, 5}, {{53, 54, 58}, 12},    {{62, 64, 70}, 7},
    {{148, 150, 154}, 8},  {{108, 110, 114}, 5}, {{40, 50, 84}, 8},     {{58, 78, 122}, 4},
    {{100, 130, 172}, 5},  {{166, 188, 212}, 5}, {{128, 38, 42}, 4},    {{170, 62, 56}, 3},
    {{74, 92, 70}, 3},     {{112, 118, 88}, 4},  {{200, 180, 146}, 5},  {{136, 112, 88}, 3},
    {{98, 74, 108}, 1.5},  {{212, 184, 104}, 2}, {{212, 160, 162}, 3},  {{92, 136, 136}, 1.5},
    {{196, 122, 84}, 1.5}, {{86, 50, 54}, 2},    {{182, 202, 186}, 1.5}};
constexpr Swatch kDress[] = {{{52, 53, 58}, 8},    {{44, 52, 86}, 6},    {{120, 40, 50}, 4},
                             {{222, 214, 200}, 4}, {{186, 104, 96}, 3},  {{150, 160, 176}, 3},
                             {{92, 108, 84}, 3},   {{206, 170, 160}, 3}, {{110, 80, 108}, 2},
                             {{94, 124, 156}, 4},  {{200, 178, 128}, 2}, {{150, 94, 66}, 2},
                             {{232, 228, 222}, 3}, {{78, 70, 70}, 3},    {{62, 92, 92}, 2}};
constexpr Swatch kDenim[] = {{{74, 94, 132}, 6}, {{52, 66, 98}, 8},  {{108, 128, 160}, 5},
                             {{42, 48, 62}, 6},  {{60, 80, 116}, 6}, {{140, 156, 178}, 2},
                             {{53, 54, 58}, 5},  {{96, 98, 104}, 3}, {{198, 196, 190}, 1}};
constexpr Swatch kTrousers[] = {{{53, 54, 58}, 6},    {{58, 59, 64}, 2},   {{46, 54, 82}, 5},
                                {{174, 156, 126}, 5}, {{128, 116, 92}, 4}, {{92, 100, 76}, 4},
                                {{130, 132, 136}, 4}, {{92, 68, 52}, 3},   {{206, 198, 182}, 3},
                                {{112, 58, 54}, 2},   {{84, 104, 134}, 3}};
constexpr Swatch kSkirt[] = {{{54, 54, 58}, 8},    {{60, 62, 70}, 5},  {{98, 98, 104}, 3},
                             {{104, 52, 56}, 3},   {{58, 70, 98}, 5},  {{150, 132, 108}, 4},
                             {{190, 174, 150}, 2}, {{94, 102, 78}, 2}, {{168, 120, 104}, 2},
                             {{84, 104, 136}, 3}};
constexpr Swatch kWorkwear[] = {{{56, 74, 112}, 6},
                                {{60, 62, 66}, 4},
                                {{88, 92, 74}, 3},
                                {{150, 120, 84}, 2},
                                {{196, 96, 48}, 1.5}};
constexpr Swatch kLeather[] = {{{58, 56, 56}, 8},    {{58, 50, 50}, 5},  {{112, 76, 52}, 4},
                               {{148, 104, 68}, 3},  {{54, 54, 58}, 5},  {{90, 86, 84}, 3},
                               {{186, 176, 162}, 1}, {{96, 48, 42}, 1.5}};
constexpr Swatch kSuit[] = {
    {{255, 255, 255}, 5}, {{178, 196, 255}, 4}, {{255, 234, 206}, 2}, {{216, 220, 232}, 3}};
constexpr Swatch kTrainers[] = {{{236, 236, 232}, 8}, {{40, 40, 44}, 7},    {{134, 136, 140}, 4},
                                {{92, 94, 98}, 3},    {{44, 56, 96}, 3},    {{70, 104, 160}, 1.5},
                                {{158, 46, 48}, 1.5}, {{196, 182, 160}, 2}, {{96, 112, 86}, 1},
                                {{206, 140, 150}, 1}};
constexpr Swatch kBag[] = {{{36, 37, 40}, 10},   {{62, 64, 70}, 6},    {{44, 54, 86}, 5},
                           {{104, 74, 54}, 5},   {{140, 46, 46}, 2},   {{88, 96, 74}, 3},
                           {{160, 134, 100}, 3}, {{122, 126, 132}, 3}, {{70, 100, 128}, 2},
                           {{184, 140, 70}, 1}};
constexpr Swatch kUmbrella[] = {{{34, 35, 39}, 10}, {{40, 50, 82}, 5},    {{124, 36, 44}, 3},
                                {{60, 84, 72}, 2},  {{196, 188, 172}, 2}, {{96, 100, 108}, 3},
                                {{200, 160, 70}, 1}};

constexpr Swatch kCoat[] = {{{56, 57, 61}, 5},    {{52, 60, 94}, 4},     {{88, 90, 96}, 4},
                            {{126, 128, 132}, 4}, {{176, 150, 112}, 4},  {{104, 82, 62}, 3},
                            {{92, 104, 70}, 3},   {{124, 50, 54}, 3},    {{70, 96, 134}, 3},
                            {{204, 194, 176}, 3}, {{196, 160, 84}, 1.5}, {{66, 96, 84}, 2},
                            {{150, 92, 96}, 2},   {{222, 222, 220}, 1}};
constexpr Swatch kLight[] = {{{238, 238, 234}, 5}, {{206, 208, 210}, 3}, {{196, 210, 226}, 3},
                             {{228, 220, 196}, 3}, {{230, 204, 120}, 3}, {{214, 148, 144}, 3},
                             {{150, 196, 206}, 3}, {{150, 180, 150}, 3}, {{172, 154, 196}, 2},
                             {{226, 150, 84}, 2},  {{176, 84, 84}, 2},   {{96, 128, 176}, 3},
                             {{142, 146, 152}, 3}};
constexpr Swatch kReflective[] = {{{214, 228, 96}, 3},
                                  {{240, 132, 60}, 3},
                                  {{226, 92, 76}, 3},
                                  {{160, 206, 150}, 2},
                                  {{240, 190, 80}, 2}};
constexpr Swatch kCamouflage[] = {{{118, 122, 92}, 4}, {{150, 130, 96}, 3},  {{112, 114, 118}, 3},
                                  {{78, 88, 62}, 3},   {{176, 164, 140}, 2}, {{84, 96, 118}, 2}};

constexpr Swatch kDarkHair[] = {{{48, 42, 39}, 5}, {{54, 45, 40}, 4}, {{64, 51, 43}, 3}};
constexpr Swatch kAnyHair[] = {{{54, 44, 38}, 4},    {{70, 51, 38}, 5},     {{92, 68, 48}, 5},
                               {{116, 88, 60}, 4},   {{152, 120, 82}, 2.5}, {{190, 160, 114}, 2},
                               {{120, 66, 42}, 1.2}, {{50, 44, 41}, 2}};
constexpr Swatch kGraying[] = {
    {{120, 114, 108}, 4}, {{74, 66, 60}, 4}, {{158, 154, 150}, 3}, {{92, 72, 56}, 3}};
constexpr Swatch kGray[] = {{{190, 188, 184}, 4}, {{222, 220, 216}, 4}, {{150, 148, 146}, 3}};

std::span<const Swatch> list_swatches(Dye dye) {
  switch (dye) {
    case Dye::dress:
      return kDress;
    case Dye::denim:
      return kDenim;
    case Dye::trousers:
      return kTrousers;
    case Dye::skirt:
      return kSkirt;
    case Dye::workwear:
      return kWorkwear;
    case Dye::suit:
      return kSuit;
    case Dye::leather:
      return kLeather;
    case Dye::trainers:
      return kTrainers;
    case Dye::bag:
      return kBag;
    case Dye::umbrella:
      return kUmbrella;
    case Dye::coat:
      return kCoat;
    case Dye::light:
      return kLight;
    case Dye::reflective:
      return kReflective;
    case Dye::camouflage:
      return kCamouflage;
    case Dye::shirt:
      break;
  }
  return kShirt;
}

std::span<const Swatch> list_swatches(HairRange range) {
  switch (range) {
    case HairRange::dark:
      return kDarkHair;
    case HairRange::graying:
      return kGraying;
    case HairRange::gray:
      return kGray;
    case HairRange::any:
      break;
  }
  return kAnyHair;
}

std::vector<Rgb> draw(std::span<const Swatch> swatches, std::size_t count, Random& random) {
  double total = 0;
  for (const Swatch& swatch : swatches) total += swatch.weight;
  std::vector<Rgb> colors;
  colors.reserve(count);
  while (colors.size() < count) {
    double left = random.uniform(0, total);
    std::size_t at = 0;
    while (at + 1 < swatches.size() && left >= swatches[at].weight) left -= swatches[at++].weight;
    colors.push_back(swatches[at].color);
  }
  return colors;
}

}  // namespace

std::vector<Rgb> draw_colors(Dye dye, std::size_t count, Random& random) {
  return draw(list_swatches(dye), count, random);
}

std::vector<Rgb> draw_hair(HairRange range, std::size_t count, Random& random) {
  return draw(list_swatches(range), count, random);
}

}  // namespace throng::skinning
