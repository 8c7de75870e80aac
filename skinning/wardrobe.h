// Clothes, shoes, hair and eyes cut into pieces that are coloured as one, with their textures.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "skinning/image.h"
#include "skinning/makehuman.h"
#include "skinning/person.h"

namespace throng::skinning {

/// Some faces of a proxy with one colouring.
struct Garment {
  const Proxy* proxy = nullptr;
  std::vector<Quad> quads;
  Tint tint = Tint::none;
  bool alpha_tested = false;
  std::string texture;  ///< key of Wardrobe::textures
};

/// Everything that a set of people wears, loaded once; read-only afterwards.
class Wardrobe {
 public:
  /// Loads what `people` wear. Textures become squares of `texture_size`; those of tinted pieces
  /// are reduced to light and shade, with the median of the piece at kMedianShade.
  Wardrobe(const MakeHuman& makehuman, const std::vector<PersonSpec>& people, int texture_size);

  /// The pieces of a proxy that are worn as `tint`; empty when it has none.
  const std::vector<Garment>& pieces(const std::string& proxy, Tint tint) const;
  const Proxy& proxy(const std::string& name) const { return proxies_.at(name); }

  /// By key. The keys of skins and eyes are their names.
  const std::map<std::string, Image>& textures() const { return textures_; }

 private:
  void add_suit(const std::string& name);
  void add_shoes(const std::string& name);
  void add_whole(const std::string& kind, const std::string& name, Tint tint);
  const Proxy& load(const std::string& kind, const std::string& name);
  void add_piece(Garment garment, Tint worn_as, const std::filesystem::path& picture,
                 const std::string& key);
  void add_picture(const std::string& key, const std::filesystem::path& picture);

  const MakeHuman* makehuman_;
  int texture_size_;
  std::map<std::string, Proxy> proxies_;
  std::map<std::pair<std::string, Tint>, std::vector<Garment>> pieces_;
  std::map<std::string, Image> textures_;
};

/// sRGB value that the median of a tinted piece's texture has: bright enough for white shirts,
/// dark enough to leave room for highlights.
inline constexpr std::uint8_t kMedianShade = 205;

/// The picture of a skin, e.g. "old_asian_male". Throws InputError when the package has none.
std::filesystem::path skin_picture(const std::filesystem::path& package, const std::string& skin);

}  // namespace throng::skinning
