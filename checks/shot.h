// An image of a dataset with its pixels and camera, and checks of single images and pairs of
// images.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "camera/camera.h"
#include "checks/findings.h"
#include "checks/pixel_rays.h"
#include "checks/pixels.h"
#include "formats/dataset/instances.h"
#include "formats/dataset/mask.h"

namespace throng::checks {

/// An image with its pixels and camera.
struct Shot {
  formats::Image image;
  Pixels pixels;
  camera::Camera camera;
  bool is_plain = true;                             ///< no lens distortion, no rolling shutter
  bool at_once = true;                              ///< no rolling shutter
  bool has_final_contrasts = true;                  ///< of the image after JPEG
  std::shared_ptr<const PixelRays> rays = nullptr;  ///< of a distorted image; may be null

  std::string record() const { return "image " + std::to_string(image.id); }
  const formats::Person* find(std::int64_t track_id) const;
  /// The visible pixels of a person.
  formats::Bitmap instance_mask(const formats::Person& person) const;
  /// camera.unproject({x, y}, depth_m) for a pixel of the image.
  Eigen::Vector3d point_at(int x, int y, double depth_m) const;
};

/// Max distance (px) in the image `to` of two points that are in neighboring pixels of `from` at
/// the same depth; at least 1.
double pixels_per_pixel(const Shot& from, const Shot& to, int x, int y, double depth_m);

/// Whether a pixel shows a static object: the ground, a building or a prop.
inline bool is_still(std::uint32_t id) {
  return (id >= formats::kFirstBuilding && id < formats::kFirstDrone) || id == formats::kGround;
}
inline bool is_building(std::uint32_t id) {
  return id >= formats::kFirstBuilding && id < formats::kFirstProp;
}

/// Compares depth and ids of static objects in two images of one run: no image sees through a
/// surface of the other, and a point has the same id in both.
void check_still_surfaces(const Shot& a, const Shot& b, Findings& findings);
/// Checks that buildings stand on the ground and not below it.
void check_buildings(const Shot& shot, Findings& findings);
/// Checks that the classes of roofs, facades, doors, markings and grass agree with shape, position
/// and color.
void check_surface_classes(const Shot& shot, Findings& findings);
/// Checks that normals face the camera and agree with the surface that the depth shows.
void check_normals(const Shot& shot, Findings& findings);
/// Compares all kinds of flow between consecutive frames of a camera with depth, cameras and
/// people.
void check_flow_between(const Shot& before, const Shot& after, Findings& findings);
/// Compares the occlusion of flow with depth and ids of the next frame.
void check_flow_occlusion(const Shot& before, const Shot& after, Findings& findings);
/// Checks that the first frame has no backward flow.
void check_first_flow(const Shot& shot, Findings& findings);
/// Checks that the last frame has no flow.
void check_last_flow(const Shot& shot, Findings& findings);
/// Checks amodal masks, boxes in the world and heads.
void check_whole_bodies(const Shot& shot, Findings& findings);
/// Compares contrasts with the image, and occluders with instances.
void check_difficulty(const formats::DatasetInfo& info, const Shot& shot, Findings& findings);
/// Checks that recorded lookalikes look alike in the image, and that no other people nearby do.
void check_lookalikes(const Shot& shot, Findings& findings);
/// Compares boxes of heads with heads, bodies and masks.
void check_heads(const formats::DatasetInfo& info, const Shot& shot, Findings& findings);
/// Compares joints, rotations of bones and gaze with each other, keypoints and the image.
void check_joints(const formats::DatasetInfo& info, const Shot& shot, Findings& findings);
/// Compares keypoints in the world with box, heading and parts.
void check_skeletons(const Shot& shot, Findings& findings);
/// Checks that walking people face the direction of their motion.
void check_facing_motion(const Shot& shot, Findings& findings);
/// Compares people in consecutive frames of one camera: positions, velocities, missing records.
void check_motion(const Shot& before, const Shot& after, Findings& findings);
/// Compares people in two cameras' images of the same time.
void check_same_instant(const Shot& a, const Shot& b, Findings& findings);

/// Compares the recorded colors of clothes with the images, per run and approximately.
class ClothesCheck {
 public:
  void add(const Shot& shot);
  void finish(Findings& findings) const;

 private:
  struct Shirt {
    std::optional<Eigen::Vector3d> label;           ///< linear light
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< sum over the pixels of the torso
    std::size_t pixels = 0;
    Eigen::Vector3d inner_sum = Eigen::Vector3d::Zero();  ///< over those far from other surfaces
    std::size_t inner_pixels = 0;
  };
  /// By run and white balance, then track: images of one shirt in two white balances differ.
  std::map<std::pair<std::string, double>, std::map<std::int64_t, Shirt>> runs_;
  std::map<std::int64_t, std::size_t> carried_;  ///< pixels of carried items by track
  std::set<std::int64_t> without_item_;          ///< tracks with such pixels that carry no item
};

/// Checks that scene flow is 0 for static objects and agrees with optical flow and the motion of
/// people, each and on the average over a run.
class SceneFlowCheck {
 public:
  void add(const Shot& before, const Shot& after, Findings& findings);
  void finish(Findings& findings) const;

 private:
  std::map<std::string, std::vector<double>> ratios_;  ///< motion of pixels by that of positions
};

/// Compares classes of surfaces with their places: the land around the ground, doors at exits (both
/// in counts/), and, over all images of a run, what faces up of buildings and what is beside paint.
class PlaceCheck {
 public:
  void add(const formats::DatasetInfo& info, const Shot& shot, Findings& findings);
  void finish(Findings& findings) const;

 private:
  /// Places in counts/RUN.json, m; empty without that file.
  struct Areas {
    Eigen::AlignedBox2d ground;
    std::map<std::string, std::pair<Eigen::Vector2d, Eigen::Vector2d>> exits;  ///< ends by id
  };
  struct Tops {
    std::size_t looked_at = 0;
    std::size_t facades = 0;
    std::string file;  ///< of the first facade
    std::string record;
  };

  /// Pixels around the ground, and on it.
  struct Land {
    std::array<std::size_t, 2> looked_at{};
    std::array<std::size_t, 2> wrong{};  ///< those of other classes around it, land on it
    std::array<std::string, 2> files;    ///< of the first wrong ones
  };
  /// The ground beside a run's markings.
  struct Paint {
    std::size_t looked_at = 0;
    std::size_t on_pavement = 0;
    std::vector<double> contrasts;  ///< brightness of paint over that of pavement
    std::string file;               ///< of the first pavement
    std::string record;
  };

  const Areas& areas_of(const formats::DatasetInfo& info, const std::string& run);
  void look_at_land(const Shot& shot, const Areas& areas);
  void report_land(Findings& findings) const;
  static void check_doors(const Shot& shot, const Areas& areas, Findings& findings);
  void look_at_tops(const Shot& shot);
  void look_at_paint(const Shot& shot);
  void report_paint(Findings& findings) const;

  std::map<std::string, Land> land_;                            ///< by run
  std::map<std::string, Areas> areas_;                          ///< by run
  std::map<std::pair<std::string, std::uint32_t>, Tops> tops_;  ///< by run and building
  std::map<std::string, Paint> paint_;                          ///< by run
};

/// Checks that outlines of labels coincide with edges in the images. Evaluated over the whole
/// dataset: images that are not too dark, foggy or noisy set the standard for the others.
class AlignmentCheck {
 public:
  void add(const Shot& shot);
  void finish(Findings& findings) const;

 private:
  struct Score {
    std::string file;
    std::string record;
    double here = 0;  ///< edge strength, in standard deviations above that at other offsets
    double best = 0;  ///< the same at the best offset
    int best_x = 0;   ///< best offset, px
    int best_y = 0;
    bool can_tell = false;  ///< light, weather and sensor permit a judgment
    bool is_line = false;   ///< the outlines mostly lie on themselves when moved along them
  };
  /// By run, camera, and whether the outlines are those of people.
  std::map<std::tuple<std::string, std::string, bool>, std::vector<Score>> scores_;
};

}  // namespace throng::checks
