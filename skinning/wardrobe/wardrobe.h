// Clothes, shoes, hair and eyes cut into pieces that are colored as one, with their textures.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "skinning/body/makehuman.h"
#include "skinning/image.h"
#include "skinning/wardrobe/garments.h"
#include "skinning/wardrobe/person.h"

namespace throng::skinning {

/// Some faces of a proxy with one coloring.
struct Garment {
  const Proxy* proxy = nullptr;
  std::vector<Quad> quads;
  Tint tint = Tint::none;
  bool alpha_tested = false;
  std::string texture;  ///< key of Wardrobe::textures
};

/// A worn garment: its pieces, and the skin that it hides.
struct Worn {
  const Proxy* proxy = nullptr;
  std::vector<Garment> pieces;
};

/// Everything that a set of people wears, loaded once; read-only afterwards.
class Wardrobe {
 public:
  /// Loads what `people` wear. Textures become squares of `texture_size`; those of tinted pieces
  /// are light and shade, with the median at kMedianShade.
  Wardrobe(const MakeHuman& makehuman, const std::vector<PersonSpec>& people, int texture_size);

  /// The outfit's garment in a slot; no pieces and no proxy if the slot is empty.
  const Worn& top(const Outfit& outfit) const;
  const Worn& bottom(const Outfit& outfit) const;
  const Worn& shoes(const Outfit& outfit) const;
  const Worn& hat(const Outfit& outfit) const;
  const Worn& hair(const Outfit& outfit) const;
  const Worn& eyebrows(const std::string& name) const;
  const Proxy& eyes() const { return *eyes_; }

  /// Author of a proxy that is worn, as the package names them; empty when it does not.
  const std::string& author_of(const std::string& proxy) const;

  /// By key. The keys of skins and eyes are their names.
  const std::map<std::string, Image>& textures() const { return textures_; }

 private:
  /// Part of a suit, its fabric and its color.
  struct Key {
    std::string name;
    Slot slot = Slot::top;
    Cloth cloth = Cloth::plain;
    Tint tint = Tint::none;
    auto operator<=>(const Key&) const = default;
  };
  static Key key_of_top(const Outfit& outfit);
  static Key key_of_bottom(const Outfit& outfit);

  const Worn& find(const Key& key) const;
  void add(const Key& key);
  void add_clothes(const Key& key, Worn& worn);
  void add_shoes(const Key& key, Worn& worn);
  void add_head(const Key& key, Worn& worn);
  const Proxy& load(const std::string& kind, const std::string& name);
  void add_piece(Worn& worn, Garment garment, Cloth cloth, const std::filesystem::path& folder);
  void add_image(const std::string& key, const std::filesystem::path& file,
                 const std::function<void(Image&)>& mend = {});

  const MakeHuman* makehuman_;
  int texture_size_;
  const Proxy* eyes_ = nullptr;
  std::map<std::string, Proxy> proxies_;
  std::map<Key, Worn> worn_;
  std::map<std::string, Image> textures_;
};

/// The image of a skin, e.g. "old_asian_male". Throws InputError when the package has none.
std::filesystem::path skin_image(const std::filesystem::path& package, const std::string& skin);

/// The package's folders that hold what these people are made of besides their bodies.
std::set<std::filesystem::path> folders_used(const std::filesystem::path& package,
                                             const std::vector<PersonSpec>& people);

}  // namespace throng::skinning
