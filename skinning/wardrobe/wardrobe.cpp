#include "skinning/wardrobe/wardrobe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "skinning/body/skin_tone.h"
#include "skinning/skeleton.h"
#include "skinning/wardrobe/cloth.h"
#include "skinning/wardrobe/headwear.h"
#include "skinning/wardrobe/reveal.h"
#include "skinning/wardrobe/skirt.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

const Worn kNothing;

fs::path proxy_folder(const fs::path& package, const std::string& kind, const std::string& name) {
  return package / "public/data/proxies" / kind / name;
}

// Pieces of a proxy that hang together, as lists of its quads.
std::vector<std::vector<Quad>> connected_pieces(const Proxy& proxy) {
  std::vector<std::uint32_t> parent(proxy.positions.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  for (const Quad& quad : proxy.quads) {
    for (const std::uint32_t vertex : quad.vertex) {
      parent[root_of(vertex)] = root_of(quad.vertex[0]);
    }
  }
  std::map<std::uint32_t, std::vector<Quad>> by_root;
  for (const Quad& quad : proxy.quads) by_root[root_of(quad.vertex[0])].push_back(quad);
  std::vector<std::vector<Quad>> pieces;
  pieces.reserve(by_root.size());
  for (auto& [unused, quads] : by_root) pieces.push_back(std::move(quads));
  return pieces;
}

bool worn_below_the_waist(const Proxy& proxy, const std::vector<Quad>& quads) {
  float below = 0;
  for (const Quad& quad : quads) {
    const BoneWeights& weights = proxy.weights[quad.vertex[0]];
    below += weights[index_from(Bone::hips)];
    for (auto bone = index_from(Bone::left_thigh); bone < kBoneCount; ++bone)
      below += weights[bone];
  }
  return below > 0.5F * static_cast<float>(quads.size());
}

void append(std::vector<Quad>& all, const std::vector<Quad>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Skin that the garment hides, and skin that it only covers. The package's own list goes right up
// to the borders, where simplified cloth leaves gaps: one row of skin more stays.
void settle_skin(const MakeHuman& makehuman, const std::string& kind, Proxy& proxy) {
  proxy.tucks.assign(proxy.hides.size(), false);
  if (kind != "clothes" && kind != "hair") return;
  if (kind == "hair" && is_made_here(proxy.name)) return;  // it lies on the skin
  const std::vector<bool> under = skin_under(makehuman, proxy);
  const bool listed = std::find(proxy.hides.begin(), proxy.hides.end(), true) != proxy.hides.end();
  proxy.tucks = without_border(makehuman, under, 1);
  for (std::size_t vertex = 0; vertex < under.size(); ++vertex) {
    if (proxy.hides[vertex]) proxy.tucks[vertex] = true;
  }
  if (kind == "hair") return;
  proxy.hides =
      listed ? without_border(makehuman, proxy.hides, 1) : without_border(makehuman, under, 2);
}

bool is_part_of_suit(Slot slot) { return slot == Slot::top || slot == Slot::bottom; }

}  // namespace

fs::path skin_image(const fs::path& package, const std::string& skin) {
  return diffuse_image(package / "public/data/skins" / skin);
}

std::set<fs::path> folders_used(const fs::path& package, const std::vector<PersonSpec>& people) {
  std::set<fs::path> folders = {proxy_folder(package, "eyes", "Low-Poly")};
  const auto add = [&](const char* kind, const std::string& name) {
    if (!name.empty() && !is_made_here(name)) folders.insert(proxy_folder(package, kind, name));
  };
  for (const PersonSpec& person : people) {
    const Outfit& outfit = person.outfit;
    for (const std::string* name : {&outfit.top, &outfit.bottom, &outfit.shoes, &outfit.hat}) {
      add("clothes", *name);
    }
    add("hair", outfit.hair);
    add("eyebrows", person.eyebrows);
    folders.insert(package / "public/data/skins" / person.skin);
  }
  return folders;
}

Wardrobe::Key Wardrobe::key_of_top(const Outfit& outfit) {
  Key key{outfit.top, Slot::top, outfit.top_cloth, Tint::top, outfit.accent};
  if (outfit.bottom.empty()) key.slot = Slot::dress;
  if (outfit.top == outfit.bottom && outfit.one_piece) key.slot = Slot::whole;
  return key;
}

Wardrobe::Key Wardrobe::key_of_bottom(const Outfit& outfit) {
  return {outfit.bottom,
          Slot::bottom,
          outfit.bottom_cloth,
          outfit.one_piece ? Tint::top : Tint::bottom,
          {255, 255, 255}};
}

Wardrobe::Key Wardrobe::key_of_tail(const Outfit& outfit) {
  return {std::string(kSkirt), Slot::bottom, outfit.top_cloth, Tint::top, outfit.accent};
}

Wardrobe::Wardrobe(const MakeHuman& makehuman, const std::vector<PersonSpec>& people,
                   int texture_size)
    : makehuman_(&makehuman), texture_size_(texture_size) {
  eyes_ = &load("eyes", "Low-Poly");
  for (const PersonSpec& person : people) {
    const Outfit& outfit = person.outfit;
    const Key top_key = key_of_top(outfit);
    add(top_key);
    if (is_part_of_suit(top_key.slot)) add(key_of_bottom(outfit));
    add({outfit.shoes, Slot::shoes});
    if (!outfit.hat.empty()) add({outfit.hat, Slot::hat});
    if (!outfit.hair.empty()) add({outfit.hair, Slot::hair});
    if (!outfit.beard.empty()) add({outfit.beard, Slot::hair});
    if (outfit.scarf) add({std::string(kScarf), Slot::hat});
    if (outfit.coat > 0) add(key_of_tail(outfit));
    add({person.eyebrows, Slot::hair});
    add_image(person.skin, skin_image(makehuman.folder(), person.skin), tone_skin);
    add_image(person.eyes, proxy_folder(makehuman.folder(), "eyes", "Low-Poly") / "textures" /
                               (person.eyes + ".png"));
  }
}

const Worn& Wardrobe::find(const Key& key) const {
  const auto found = worn_.find(key);
  return found == worn_.end() ? kNothing : found->second;
}

const Worn& Wardrobe::top(const Outfit& outfit) const { return find(key_of_top(outfit)); }
const Worn& Wardrobe::bottom(const Outfit& outfit) const { return find(key_of_bottom(outfit)); }
const Worn& Wardrobe::tail(const Outfit& outfit) const {
  return outfit.coat > 0 ? find(key_of_tail(outfit)) : kNothing;
}
const Worn& Wardrobe::shoes(const Outfit& outfit) const {
  return find({outfit.shoes, Slot::shoes});
}
const Worn& Wardrobe::hat(const Outfit& outfit) const { return find({outfit.hat, Slot::hat}); }
const Worn& Wardrobe::hair(const Outfit& outfit) const { return find({outfit.hair, Slot::hair}); }
const Worn& Wardrobe::beard(const Outfit& outfit) const { return find({outfit.beard, Slot::hair}); }
const Worn& Wardrobe::scarf(const Outfit& outfit) const {
  return outfit.scarf ? find({std::string(kScarf), Slot::hat}) : kNothing;
}
const Worn& Wardrobe::eyebrows(const std::string& name) const { return find({name, Slot::hair}); }

const std::string& Wardrobe::author_of(const std::string& proxy) const {
  const auto found = proxies_.find(proxy);
  check(found != proxies_.end(), "the wardrobe holds what is worn");
  return found->second.author;
}

const Proxy& Wardrobe::load(const std::string& kind, const std::string& name) {
  const auto found = proxies_.find(name);
  if (found != proxies_.end()) return found->second;
  static_cast<void>(find_license(name));  // only what is listed with its terms gets in
  Proxy proxy = name == kSkirt       ? make_skirt(*makehuman_)
                : is_made_here(name) ? make_headwear(*makehuman_, name)
                                     : makehuman_->load_proxy(kind, name);
  settle_skin(*makehuman_, kind, proxy);
  if (kind != "clothes" && !is_made_here(name)) {
    // Hair that partly hung on the neck would slip on a turning head.
    for (BoneWeights& weights : proxy.weights) {
      weights[index_from(Bone::head)] += std::exchange(weights[index_from(Bone::neck)], 0);
    }
  }
  return proxies_.emplace(name, std::move(proxy)).first->second;
}

void Wardrobe::add(const Key& key) {
  const auto [entry, is_new] = worn_.try_emplace(key);
  if (!is_new) return;
  Worn& worn = entry->second;
  switch (key.slot) {
    case Slot::shoes:
      return add_shoes(key, worn);
    case Slot::hat:
    case Slot::hair:
      return add_head(key, worn);
    default:
      return add_clothes(key, worn);
  }
}

void Wardrobe::add_clothes(const Key& key, Worn& worn) {
  const Proxy& proxy = load("clothes", key.name);
  worn.proxy = &proxy;
  const fs::path folder = proxy_folder(makehuman_->folder(), "clothes", key.name);
  const auto belongs = [&](const std::vector<Quad>& quads) {
    if (key.name == kSkirt || !is_part_of_suit(key.slot)) return true;
    return worn_below_the_waist(proxy, quads) == (key.slot == Slot::bottom);
  };
  const auto cut = connected_pieces(proxy);
  std::size_t largest = 0;
  for (const auto& quads : cut) {
    if (belongs(quads)) largest = std::max(largest, quads.size());
  }
  Garment cloth{&proxy, {}, key.tint, false, {}};
  Garment trimmings{&proxy, {}, Tint::none, false, {}};  // linings, belts and buttons
  for (const auto& quads : cut) {
    if (!belongs(quads)) continue;
    const bool main = key.cloth == Cloth::own || 4 * quads.size() > largest;
    append(main ? cloth.quads : trimmings.quads, quads);
  }
  add_piece(worn, std::move(cloth), key, key.cloth, folder);
  if (!trimmings.quads.empty()) add_piece(worn, std::move(trimmings), key, Cloth::print, folder);
}

void Wardrobe::add_shoes(const Key& key, Worn& worn) {
  const Proxy& proxy = load("clothes", key.name);
  worn.proxy = &proxy;
  const fs::path folder = proxy_folder(makehuman_->folder(), "clothes", key.name);
  Garment shoes{&proxy, {}, Tint::shoes, false, {}};
  Garment socks{&proxy, {}, Tint::shoes, false, {}};
  for (const auto& quads : connected_pieces(proxy)) {
    float shin = 0;
    for (const Quad& quad : quads) {
      const BoneWeights& weights = proxy.weights[quad.vertex[0]];
      shin += weights[index_from(Bone::left_shin)] + weights[index_from(Bone::right_shin)];
    }
    const bool sock = shin > 0.3F * static_cast<float>(quads.size());
    append(sock ? socks.quads : shoes.quads, quads);
  }
  if (!shoes.quads.empty()) add_piece(worn, std::move(shoes), key, Cloth::print, folder);
  if (!socks.quads.empty()) add_piece(worn, std::move(socks), key, Cloth::print, folder);
}

void Wardrobe::add_head(const Key& key, Worn& worn) {
  const bool hat = key.slot == Slot::hat;
  const bool brow = key.name.starts_with("eyebrow");
  const char* kind = hat ? "clothes" : brow ? "eyebrows" : "hair";
  const Proxy& proxy = load(kind, key.name);
  worn.proxy = &proxy;
  add_piece(worn, {&proxy, proxy.quads, hat ? Tint::shoes : Tint::hair, !hat, {}}, key,
            Cloth::print, proxy_folder(makehuman_->folder(), kind, key.name));
}

Image Wardrobe::make_image(const Garment& garment, Cloth cloth, const fs::path& folder,
                           Mask& covered) const {
  const ClothFaces faces{garment.proxy, garment.quads};
  const std::string& name = garment.proxy->name;
  constexpr int kOwnTexels = 512;  // as the package's images
  if (is_made_here(name)) {
    constexpr double kSkirtFolds = 0.14;
    constexpr double kCoatFolds = 0.05;
    Image image = name == kSkirt
                      ? skirt_cloth(kOwnTexels, is_outerwear(cloth) ? kCoatFolds : kSkirtFolds)
                      : headwear_cloth(name, kOwnTexels);
    if (name != kSkirt) {
      thin_out(image, faces,
               [&](const Eigen::Vector3f& point) { return hair_density(name, point); });
    }
    covered = covered_by(faces, image);
    return image;
  }
  Image image = images::read_png(diffuse_image(folder));
  covered = covered_by(faces, image);
  if (cloth == Cloth::print) {
    // Painted hair darkens so much toward its tips, and trainers are so black and white, that they
    // would look two-colored.
    const bool is_soft = garment.tint == Tint::hair || garment.tint == Tint::shoes;
    reduce_to_shade(image, covered, is_soft ? 0.5 : 0.9);
    if (garment.tint == Tint::hair) paint_strands(image, faces, covered);
  } else if (cloth != Cloth::own) {
    image = plain_cloth(folder, covered);
    covered = covered_by(faces, image);
  }
  return image;
}

void Wardrobe::add_piece(Worn& worn, Garment garment, const Key& key, Cloth cloth,
                         const fs::path& folder) {
  const ClothFaces faces{garment.proxy, garment.quads};
  // Garments of the same cut and fabric share one texture, whatever their tint.
  std::uint64_t corners = 0;
  for (const Quad& quad : garment.quads) corners = 31 * corners + quad.uv[0];
  garment.texture = fmt::format("{}~{}~{:x}~{}", garment.proxy->name, static_cast<int>(cloth),
                                corners, fmt::join(key.accent, "-"));
  if (!textures_.contains(garment.texture)) {
    Mask covered;
    Image image = make_image(garment, cloth, folder, covered);
    paint_pattern(image, faces, cloth, key.accent);
    for (std::size_t at = 0; at < covered.size(); ++at) {
      std::uint8_t& alpha = image.rgba[4 * at + 3];
      if (!garment.alpha_tested) alpha = 255;
      if (alpha < 128) covered[at] = 0;
    }
    fill_from_nearest(image, std::move(covered));
    textures_.emplace(garment.texture, resized(image, texture_size_));
  }
  worn.pieces.push_back(std::move(garment));
}

void Wardrobe::add_image(const std::string& key, const fs::path& file,
                         const std::function<void(Image&)>& mend) {
  if (textures_.contains(key)) return;
  Image image = images::read_png(file);
  for (std::size_t at = 3; at < image.rgba.size(); at += 4) image.rgba[at] = 255;
  image = resized(image, texture_size_);
  if (mend) mend(image);
  textures_.emplace(key, std::move(image));
}

}  // namespace throng::skinning
