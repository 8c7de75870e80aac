#include "skinning/population.h"

#include <fmt/format.h>
#include <algorithm>

#include <map>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/files/resources.h"
#include "skinning/glb.h"
#include "skinning/image.h"
#include "skinning/population_files.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

// Images that several characters share (shoes, eyes) become one layer.
class TextureLayers {
 public:
  explicit TextureLayers(Population& population) : population_(&population) {}

  std::int32_t layer_of(const std::string& png, const fs::path& file) {
    const auto [entry, is_new] = layers_.try_emplace(
        sha256_hex(png), static_cast<std::int32_t>(population_->textures.size()));
    if (is_new) {
      Image image = images::decode_png(png, file.string());
      const int size = population_->texture_size;
      if (image.width != size || image.height != size) {
        throw InputError({file.string(), "",
                          fmt::format("a {}x{} texture", image.width, image.height),
                          fmt::format("{}x{} (run `throng people build`)", size, size)});
      }
      population_->textures.push_back({std::move(image.rgba)});
    }
    return entry->second;
  }

 private:
  Population* population_;
  std::map<std::string, std::int32_t> layers_;
};

}  // namespace

Population load_population(const fs::path& folder) {
  const PopulationIndex index = read_index(folder);
  Population population;
  population.content_hash = index.content_hash;
  population.texture_size = index.texture_size;
  population.clips = index.clips;
  population.palettes_per_character = index.palettes_per_character;
  TextureLayers layers(population);
  std::vector<Joints> joints;
  for (const Character& entry : index.characters) {
    const fs::path file = folder / (entry.name + kMeshExtension);
    if (!fs::is_regular_file(file)) {
      throw InputError({file.string(), "", "no such file",
                        "the character that population.json lists (run `throng people build`)"});
    }
    CharacterAsset asset = read_glb(file);
    for (Mesh& mesh : asset.levels) {
      for (Part& part : mesh.parts) {
        for (std::int32_t* image : {&part.texture, &part.shades}) {
          if (*image < 0) continue;
          *image = layers.layer_of(asset.images[static_cast<std::size_t>(*image)], file);
        }
      }
    }
    Character& character = population.characters.emplace_back(entry);
    character.levels = std::move(asset.levels);
    character.joints = asset.joints;
    joints.push_back(asset.joints);
  }
  population.palettes = read_palettes(folder, joints, population.palettes_per_character);
  return population;
}

fs::path population_folder() { return resource_folder("THRONG_PEOPLE", "people", "build/people"); }

bool is_apart(const Character& character, const Part& part) {
  const bool is_thing = character.carries == Carry::umbrella || is_led(character.carries);
  return is_thing && part.tint == Tint::item;
}

Eigen::Vector3f skin(const Vertex& vertex, const Palette& a, const Palette& b, float blend) {
  BoneMatrix matrix = BoneMatrix::Zero();
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const std::size_t bone = vertex.bones[slot];
    const float weight = static_cast<float>(vertex.weights[slot]) / 255;
    matrix += weight * ((1 - blend) * bone_matrix(a, bone) + blend * bone_matrix(b, bone));
  }
  const Eigen::Vector3f position(vertex.position[0], vertex.position[1], vertex.position[2]);
  return matrix.leftCols<3>() * position + matrix.col(3);
}

bool moves_mostly_with(const Vertex& vertex, std::initializer_list<Bone> bones) {
  constexpr int kHalf = 127;  // weights sum to 255
  int weight = 0;
  for (std::size_t i = 0; i < vertex.bones.size(); ++i) {
    const auto bone = static_cast<Bone>(vertex.bones[i]);
    if (std::find(bones.begin(), bones.end(), bone) != bones.end()) weight += vertex.weights[i];
  }
  return weight > kHalf;
}

}  // namespace throng::skinning
