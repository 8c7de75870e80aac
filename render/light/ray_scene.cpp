#include "render/light/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/files/hash.h"
#include "render/props/leaf_sprites.h"

namespace throng::render {

namespace {

using Eigen::Vector3f;

constexpr std::uint16_t kClosed = 0x8000;
constexpr unsigned kSolid = 0;
constexpr unsigned kLeaves = 1;

/// Cover of the leaves' sprites, as coarse as rays need.
struct Sprites {
  static constexpr int kTexels = 64;
  std::array<std::vector<LeafTexel>, kLeafSprites> cover;

  Sprites() {
    for (int i = 0; i < kLeafSprites; ++i) {
      constexpr std::size_t kLevel = 2;
      static_assert(kLeafTexels >> kLevel == kTexels);
      cover.at(static_cast<std::size_t>(i)) =
          draw_leaf_sprite(static_cast<LeafSprite>(i)).at(kLevel);
    }
  }
  bool covers(const Eigen::Vector2f& card) const {
    const float layer = std::floor(card.x() / 2);
    if (layer >= kLeafSprites) return false;  // letters are flat on their signs
    const auto texel = [](float share) {
      return std::clamp(static_cast<int>(share * kTexels), 0, kTexels - 1);
    };
    const int sprite = std::max(static_cast<int>(layer), 0);
    const int at = texel(card.y()) * kTexels + texel(card.x() - 2 * layer);
    return cover[static_cast<std::size_t>(sprite)][static_cast<std::size_t>(at)].cover >= 128;
  }
};

const Sprites& sprites() {
  static const Sprites kSprites;
  return kSprites;
}

/// Lets rays pass between leaves.
void pass_between_leaves(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] != -1) return;
  const auto& cards = *static_cast<const std::vector<Eigen::Vector2f>*>(arguments->geometryUserPtr);
  const float u = RTCHitN_u(arguments->hit, 1, 0);
  const float v = RTCHitN_v(arguments->hit, 1, 0);
  const std::size_t first = std::size_t{3} * RTCHitN_primID(arguments->hit, 1, 0);
  const Eigen::Vector2f card =
      (1 - u - v) * cards[first] + u * cards[first + 1] + v * cards[first + 2];
  // Leaves let as much light through as they throw back: every second ray goes on.
  const float turn =
      4096 * (RTCRayN_dir_x(arguments->ray, 1, 0) + RTCRayN_dir_y(arguments->ray, 1, 0));
  const bool passes = std::fmod(std::abs(turn) + 0.37F * static_cast<float>(first), 1.0F) < 0.5F;
  if (passes || !sprites().covers(card)) arguments->valid[0] = 0;
}

RTCRay make_ray(const Vector3f& from, const Vector3f& direction, float skipped_m,
                float distance_m) {
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = skipped_m;
  ray.tfar = distance_m;
  ray.mask = ~0U;
  return ray;
}

}  // namespace

struct RayScene::Device {
  // One thread builds, so that the tree of boxes, and with it which of two coinciding triangles a
  // ray meets, is always the same.
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  RTCScene scene = rtcNewScene(device);

  Device() = default;
  ~Device() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void add(const std::vector<Vector3f>& corners, unsigned id,
           const std::vector<Eigen::Vector2f>* cards) {
    if (corners.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vector3f), corners.size()));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), corners.size() / 3));
    if (vertices == nullptr || indices == nullptr)
      throw EnvironmentError("no memory for the rays of light");
    for (std::size_t i = 0; i < corners.size(); ++i) {
      std::copy_n(corners[i].data(), 3, vertices + 3 * i);
      indices[i] = static_cast<unsigned>(i);
    }
    if (cards != nullptr) {
      // Embree's interface takes no constant pointer; the filter only reads.
      rtcSetGeometryUserData(geometry, const_cast<std::vector<Eigen::Vector2f>*>(cards));
      rtcSetGeometryIntersectFilterFunction(geometry, pass_between_leaves);
      rtcSetGeometryOccludedFilterFunction(geometry, pass_between_leaves);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }
};

RayScene::RayScene() = default;
RayScene::~RayScene() = default;

std::uint16_t RayScene::index_of(const RaySurface& surface) {
  const auto byte = [&](std::size_t i) { return static_cast<float>(surface.albedo.at(i)); };
  const std::array<float, 6> key = {byte(0),          byte(1),          byte(2),
                                    surface.glow.x(), surface.glow.y(), surface.glow.z()};
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  // A place has tens of colors; the meshes of a user may have more, the last of which look alike.
  constexpr std::size_t kMax = kClosed - 1;
  if (surfaces_.size() == kMax) return kMax - 1;
  surfaces_.push_back(surface);
  return known_[key] = static_cast<std::uint16_t>(surfaces_.size() - 1);
}

void RayScene::push(const std::array<Vector3f, 3>& corners, std::uint16_t surface, bool closed) {
  solid_.insert(solid_.end(), corners.begin(), corners.end());
  solid_surface_.push_back(closed ? surface | kClosed : surface);
}

void RayScene::add_triangle(const SceneryMesh& mesh, std::size_t first, const RaySurface& surface) {
  std::array<Vector3f, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners.at(k) = Vector3f(mesh.vertices[mesh.indices[first + k]].position.data());
  }
  push(corners, index_of(surface), true);
}

void RayScene::add(const SceneryMesh& mesh, const Range& range, const RaySurface& surface) {
  for (std::size_t i = range.first; i < std::size_t{range.first} + range.count; i += 3)
    add_triangle(mesh, i, surface);
}

void RayScene::add(const PropMesh& mesh, const Eigen::Array3f& lamp_color) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<Vector3f, 3> corners;
    std::array<Eigen::Vector2f, 3> cards;
    for (std::size_t k = 0; k < 3; ++k) {
      const PropVertex& vertex = mesh.vertices[mesh.indices[i + k]];
      corners.at(k) = Vector3f(vertex.position.data());
      cards.at(k) = Eigen::Vector2f(vertex.card.data());
    }
    const auto& paint = mesh.vertices[mesh.indices[i]].paint;
    const auto finish = static_cast<Finish>(paint[3]);
    RaySurface surface{{paint[0], paint[1], paint[2]}, Eigen::Array3f::Zero()};
    // As in shaders/prop.frag.glsl: the mean of what a screen shows, and of lit glass. Lamps are
    // points (scenery/lamps.h).
    if (finish == Finish::screen) surface.glow = 3.5e-4F * lamp_color;
    if (finish == Finish::lit_glass) surface.glow = 1.9e-4F * lamp_color;
    const std::uint16_t index = index_of(surface);
    if (finish == Finish::leaves) {
      leaves_.insert(leaves_.end(), corners.begin(), corners.end());
      cards_.insert(cards_.end(), cards.begin(), cards.end());
      leaf_surface_.push_back(index);
    } else {
      push(corners, index, false);
    }
  }
}

void RayScene::build() {
  device_ = std::make_unique<Device>();
  device_->add(solid_, kSolid, nullptr);
  device_->add(leaves_, kLeaves, &cards_);
  rtcSetSceneFlags(device_->scene, RTC_SCENE_FLAG_COMPACT);
  rtcCommitScene(device_->scene);
  if (rtcGetDeviceError(device_->device) != RTC_ERROR_NONE)
    throw EnvironmentError("no memory for the rays of light");
}

std::optional<RayHit> RayScene::trace(const Vector3f& from, const Vector3f& direction,
                                      float skipped_m) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = make_ray(from, direction, skipped_m, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(device_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const bool is_leaf = query.hit.geomID == kLeaves;
  const std::uint16_t surface = (is_leaf ? leaf_surface_ : solid_surface_)[query.hit.primID];
  Vector3f normal = Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
  RayHit hit;
  hit.position = from + query.ray.tfar * direction;
  const bool behind = normal.dot(direction) > 0;
  hit.is_back = behind && (surface & kClosed) != 0;
  hit.normal = behind ? Vector3f(-normal) : normal;
  hit.surface = &surfaces_[surface & ~kClosed];
  return hit;
}

bool RayScene::is_free(const Vector3f& from, const Vector3f& direction, float distance_m,
                       float skipped_m) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(from, direction, skipped_m, distance_m);
  rtcOccluded1(device_->scene, &context, &ray);
  return ray.tfar >= 0;
}

std::string RayScene::fingerprint() const {
  std::string bytes;
  const auto append = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  append(solid_);
  append(leaves_);
  append(cards_);
  append(solid_surface_);
  append(leaf_surface_);
  for (const RaySurface& surface : surfaces_) {
    append(surface.albedo);
    append(std::vector<float>(surface.glow.data(), surface.glow.data() + 3));
  }
  return sha256_hex(bytes);
}

}  // namespace throng::render
