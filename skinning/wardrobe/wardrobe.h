// Clothes, shoes, hair and eyes, divided into pieces with one tint each, and their textures.
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

/// Faces of a proxy with one tint and texture.
struct Garment {
  const Proxy* proxy = nullptr;
  std::vector<Quad> quads;
  Tint tint = Tint::none;
  bool alpha_tested = false;
  std::string texture;  ///< key of Wardrobe::textures
};

/// A worn garment: its proxy, which lists the covered skin, and its pieces.
struct Worn {
  const Proxy* proxy = nullptr;
  std::vector<Garment> pieces;
};

/// The garments of a set of people, loaded once and immutable afterwards.
class Wardrobe {
 public:
  /// Loads the garments of `people`. Textures are resized to squares of `texture_size`; those of
  /// tinted pieces are reduced to light and shade with the median kMedianShade.
  Wardrobe(const MakeHuman& makehuman, const std::vector<PersonSpec>& people, int texture_size);

  /// The outfit's garment in a slot; without proxy and pieces if the slot is empty.
  const Worn& top(const Outfit& outfit) const;
  const Worn& bottom(const Outfit& outfit) const;
  /// The tail of a coat below its top.
  const Worn& tail(const Outfit& outfit) const;
  const Worn& shoes(const Outfit& outfit) const;
  const Worn& hat(const Outfit& outfit) const;
  const Worn& hair(const Outfit& outfit) const;
  const Worn& beard(const Outfit& outfit) const;
  const Worn& scarf(const Outfit& outfit) const;
  const Worn& eyebrows(const std::string& name) const;
  const Proxy& eyes() const { return *eyes_; }

  /// The author of a worn proxy as stated in the package, or "".
  const std::string& author_of(const std::string& proxy) const;

  /// All textures by key. The keys of skins and eyes are their names.
  const std::map<std::string, Image>& textures() const { return textures_; }

 private:
  /// A garment with its cloth and tint.
  struct Key {
    std::string name;
    Slot slot = Slot::top;
    Cloth cloth = Cloth::plain;
    Tint tint = Tint::none;
    Rgb accent{255, 255, 255};
    auto operator<=>(const Key&) const = default;
  };
  static Key key_of_top(const Outfit& outfit);
  static Key key_of_bottom(const Outfit& outfit);
  static Key key_of_tail(const Outfit& outfit);

  const Worn& find(const Key& key) const;
  void add(const Key& key);
  void add_clothes(const Key& key, Worn& worn);
  void add_shoes(const Key& key, Worn& worn);
  void add_head(const Key& key, Worn& worn);
  const Proxy& load(const std::string& kind, const std::string& name);
  void add_piece(Worn& worn, Garment garment, const Key& key, Cloth cloth,
                 const std::filesystem::path& folder);
  Image make_image(const Garment& garment, Cloth cloth, const std::filesystem::path& folder,
                   Mask& covered) const;
  void add_image(const std::string& key, const std::filesystem::path& file,
                 const std::function<void(Image&)>& mend = {});

  const MakeHuman* makehuman_;
  int texture_size_;
  const Proxy* eyes_ = nullptr;
  std::map<std::string, Proxy> proxies_;
  std::map<Key, Worn> worn_;
  std::map<std::string, Image> textures_;
};

/// The image of a skin, such as "old_asian_male". Throws InputError if the package has none.
std::filesystem::path skin_image(const std::filesystem::path& package, const std::string& skin);

/// The package's folders with the assets of these people, except the body.
std::set<std::filesystem::path> folders_used(const std::filesystem::path& package,
                                             const std::vector<PersonSpec>& people);

}  // namespace throng::skinning
