// One image of a dataset with everything that belongs to it, as checks take it, alone or in
// pairs.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "camera/camera.h"
#include "formats/dataset/instances.h"
#include "formats/dataset/mask.h"
#include "formats/validate/findings.h"
#include "formats/validate/pixel_rays.h"
#include "formats/validate/pixels.h"

namespace throng::formats {

struct Shot {
  Image image;
  Pixels pixels;
  camera::Camera camera;
  bool is_plain = true;                             ///< no lens distortion, no rolling shutter
  bool at_once = true;                              ///< no rolling shutter
  std::shared_ptr<const PixelRays> rays = nullptr;  ///< of a distorted image; may be missing

  std::string record() const { return "image " + std::to_string(image.id); }
  const Person* find(std::int64_t track_id) const;
  /// Visible pixels of somebody in the image.
  Bitmap instance_mask(const Person& person) const;
  /// camera.unproject({x, y}, depth_m) for a pixel of the image.
  Eigen::Vector3d point_at(int x, int y, double depth_m) const;
};

/// How far apart two points are in the next image, at most, that are at one depth in neighboring
/// pixels of this one; at least 1.
double pixels_per_pixel(const Shot& from, const Shot& to, int x, int y, double depth_m);

/// Whether a pixel shows something that never moves: the ground, a building or a prop.
inline bool is_still(std::uint32_t id) {
  return (id >= kFirstBuilding && id < kFirstDrone) || id == kGround;
}
inline bool is_building(std::uint32_t id) { return id >= kFirstBuilding && id < kFirstProp; }

/// Depth and ids of what stands still, seen twice: no image sees through what another one shows,
/// and one place has one id. Of two images of one run.
void check_still_surfaces(const Shot& a, const Shot& b, Findings& findings);
/// Buildings stand on the ground and not below it.
void check_buildings(const Shot& shot, Findings& findings);
/// Classes of roofs, facades, doors, markings and grass go with their shape, place and color.
void check_surface_classes(const Shot& shot, Findings& findings);
/// Normals face the camera and are those of the surface that the depth shows.
void check_normals(const Shot& shot, Findings& findings);
/// Flow of all kinds against depth, cameras and people, between a frame and the next of its camera.
void check_flow_between(const Shot& before, const Shot& after, Findings& findings);
/// Motion in the world is 0 for what stands still, leads where flow does, and people move with it.
void check_scene_flow(const Shot& before, const Shot& after, Findings& findings);
/// The occlusion of flow against depth and ids of the next frame.
void check_flow_occlusion(const Shot& before, const Shot& after, Findings& findings);
/// The first frame has no backward flow.
void check_first_flow(const Shot& shot, Findings& findings);
/// The last frame has no flow.
void check_last_flow(const Shot& shot, Findings& findings);
/// Whole bodies: amodal masks, boxes in the world and heads.
void check_whole_bodies(const Shot& shot, Findings& findings);
/// Contrasts against the image; occluders against instances.
void check_difficulty(const DatasetInfo& info, const Shot& shot, Findings& findings);
/// By how much the colors of a few pixels may differ from those before compression, CIELAB: what is
/// less than half a step of JPEG's quantization (steps of quality 50 are 10 to 100 of 255 levels)
/// is lost, or becomes a step.
double compression_slack(const Image& image);
/// People who are said to look alike do in the image, and no others nearby.
void check_lookalikes(const Shot& shot, Findings& findings);
/// Boxes of heads against heads, bodies and masks.
void check_heads(const DatasetInfo& info, const Shot& shot, Findings& findings);
/// Joints, turns of bones and gaze against each other, keypoints and the image.
void check_joints(const DatasetInfo& info, const Shot& shot, Findings& findings);
/// Keypoints in the world against box, heading and parts.
void check_skeletons(const Shot& shot, Findings& findings);
/// People of consecutive frames of one camera: places, velocities, who is left out.
/// Walkers face where they go.
void check_facing_motion(const Shot& shot, Findings& findings);
void check_motion(const Shot& before, const Shot& after, Findings& findings);
/// People of two cameras' images of one instant.
void check_same_instant(const Shot& a, const Shot& b, Findings& findings);

/// Colors of clothes are those that the images show, more or less. Judged for each run.
class ClothesCheck {
 public:
  void add(const Shot& shot);
  void finish(Findings& findings) const;

 private:
  struct Shirt {
    std::optional<Eigen::Vector3d> label;           ///< linear light
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of the pixels of the torso
    std::size_t pixels = 0;
  };
  std::map<std::string, std::map<std::int64_t, Shirt>> runs_;  ///< by track
  std::map<std::int64_t, std::size_t> carried_;  ///< pixels of carried items, by track
  std::set<std::int64_t> without_item_;          ///< tracks of these that carry nothing
};

/// Outlines of labels are where the images have edges. Judged when all of a dataset is seen:
/// images that can tell (not too dark, foggy or noisy) say what the others must be like.
class AlignmentCheck {
 public:
  void add(const Shot& shot);
  void finish(Findings& findings) const;

 private:
  struct Score {
    std::string file;
    std::string record;
    double here = 0;  ///< standard deviations above other places
    double best = 0;  ///< the same at the best place
    int best_x = 0;   ///< px away
    int best_y = 0;
    bool can_tell = false;  ///< by light, weather and sensor
  };
  /// By run, camera, and whether it is people's outlines.
  std::map<std::tuple<std::string, std::string, bool>, std::vector<Score>> scores_;
};

}  // namespace throng::formats
