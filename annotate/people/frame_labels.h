// Labels of a frame: people, and other objects.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "render/frame/frame.h"

namespace throng::annotate {

/// Bounds in whole pixels: [x, x + width) x [y, y + height).
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Run lengths of a mask in COCO's order: column by column, starting with a run of zeros.
using RunLengths = std::vector<std::uint32_t>;

/// One of COCO's keypoints in the image.
struct Keypoint {
  double x = 0;  ///< box coordinates, rounded to kPixelDecimals; 0 if not labeled
  double y = 0;
  /// COCO's values: 0 not labeled (outside of the image), 1 hidden (also by the own body), 2
  /// visible.
  int visibility = 0;
};

/// A joint in the image (skinning/landmarks.h).
struct JointLabel {
  double x = 0;  ///< box coordinates, rounded to kPixelDecimals; 0 outside of the image
  double y = 0;
  enum class State : std::uint8_t {
    outside,      ///< outside of the image
    hidden,       ///< hidden by another object
    visible,      ///< by the rule of add_keypoints()
    self_hidden,  ///< hidden by the own body
  } state = State::outside;
};

/// Measures of how difficult a person is to detect and track.
struct Difficulty {
  double contrast = 0;        ///< Contrast::region (annotate/people/contrast.h)
  double edge_contrast = 0;   ///< Contrast::edge
  double blur_px = 0;         ///< motion in the image during the exposure
  int visible_keypoints = 0;  ///< number of COCO's 17 keypoints that are visible
  /// Agents nearby who look alike, nearest first (annotate/people/lookalikes.h).
  std::vector<std::uint32_t> lookalikes = {};
};

/// The nearest hazard to a person (annotate/people/hazard_view.h).
struct Danger {
  std::size_t hazard = 0;  ///< index in the scenario's list
  double distance_m = 0;   ///< distance to the edge of its reach; 0 inside
  double inside_s = 0;     ///< total time so far within reach of any hazard
};

/// A person's head in the image (annotate/people/head_labels.h).
struct HeadLabel {
  Eigen::AlignedBox2d box;  ///< as render::PersonInView::head_box
  /// The person's visible pixels with centers in the box over those that would be visible without
  /// other objects; none if the latter number is 0.
  std::optional<double> visibility = std::nullopt;
};

/// An instance that occludes a part of a person.
struct Occluder {
  std::uint32_t instance = 0;  ///< value in instances/*.png
  double share = 0;            ///< occluded share of the person's amodal area
};
/// Occluders with a smaller share are left out.
inline constexpr double kMinOccludedShare = 0.0005;

/// Actions of a person in an image (annotate/people/actions.h).
struct ActionLabel {
  std::vector<std::string_view> names;
  /// Agents of the same group nearby, whether the image shows them or not.
  std::vector<std::uint32_t> together_with;
};

/// A person with at least one visible pixel. Optional members are set if the job requests them.
struct PersonLabel {
  std::uint32_t agent = 0;
  PixelBox box;               ///< tight bounds of the visible mask
  RunLengths mask;            ///< visible mask
  std::uint64_t area_px = 0;  ///< visible pixels
  double visibility = 0;      ///< area_px / amodal area, in (0, 1]
  /// Amodal box, 3-D position and more; its amodal area is at least area_px.
  render::PersonInView person;
  std::vector<Keypoint> keypoints;  ///< in the order of skinning::kKeypointNames, or empty
  std::vector<JointLabel> joints;   ///< in the order of skinning::Joint, or empty
  std::optional<Difficulty> difficulty = std::nullopt;
  std::optional<ActionLabel> actions = std::nullopt;
  std::optional<HeadLabel> head = std::nullopt;
  std::optional<Danger> danger = std::nullopt;
  std::optional<std::vector<Occluder>> occluders = std::nullopt;
};

/// A person within the image without a visible pixel.
struct HiddenPerson {
  std::uint32_t agent = 0;
  Eigen::AlignedBox2d amodal_box;  ///< box coordinates; reaches into the image
};

/// A vehicle or another drone with at least one visible pixel.
struct ObjectLabel {
  PixelBox box;               ///< tight bounds of the visible mask
  RunLengths mask;            ///< visible mask
  std::uint64_t area_px = 0;  ///< visible pixels
  double visibility = 0;      ///< area_px / amodal area, in (0, 1]
  render::ObjectInView object;
};

/// All labels of a frame.
struct FrameLabels {
  std::int64_t frame_index = 0;
  double time_s = 0;
  std::vector<PersonLabel> people;   ///< people with a visible pixel, sorted by agent id
  std::vector<HiddenPerson> hidden;  ///< other people whose amodal boxes reach into the image
  std::vector<ObjectLabel> objects;  ///< drones and vehicles with a visible pixel
};

}  // namespace throng::annotate
