// Labels of the visible people in one frame, from its id buffer: boxes, masks, visibility.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/frame.h"

namespace throng::annotate {

/// Integer pixel bounds: covers [x, x + width) x [y, y + height).
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Runs of a mask in COCO's order: down the columns, first run counts zeros.
using RunLengths = std::vector<std::uint32_t>;

/// One of COCO's keypoints in the image.
struct Keypoint {
  double x = 0;  ///< box coordinates, rounded to kPixelDecimals; 0 when not labeled
  double y = 0;
  /// COCO's: 0 not labeled (outside the image), 1 hidden, by others or by the own body, 2 visible.
  int visibility = 0;
};

/// A joint in the image (annotate/skeletons.h).
struct JointLabel {
  double x = 0;  ///< box coordinates, rounded to kPixelDecimals; 0 outside of the image
  double y = 0;
  enum class State : std::uint8_t {
    outside,      ///< of the image
    hidden,       ///< by something else
    visible,      ///< as of keypoints
    self_hidden,  ///< by the own body
  } state = State::outside;
};

/// How hard somebody is to see (annotate/people/contrast.h).
struct Difficulty {
  double contrast = 0;        ///< color difference to the surroundings
  double edge_contrast = 0;   ///< median color difference along the outline
  double blur_px = 0;         ///< motion in the image during the exposure
  int visible_keypoints = 0;  ///< of COCO's 17
  /// Agents nearby who look alike, the nearest first (annotate/people/lookalikes.h).
  std::vector<std::uint32_t> lookalikes = {};
};

/// The nearest hazard to a person (annotate/people/hazard_view.h).
struct Danger {
  std::size_t hazard = 0;  ///< in the scenario's list
  double distance_m = 0;   ///< from the edge of its reach; 0 within
  double inside_s = 0;     ///< time within reach of any hazard so far
};

/// A person's head in the image (annotate/people/head_labels.h).
struct HeadLabel {
  Eigen::AlignedBox2d box;  ///< as render::PersonInView::head_box
  /// Visible pixels of the person whose middles are in the box, by those that would be were nothing
  /// in front; none where there are none.
  std::optional<double> visibility = std::nullopt;
};

/// An instance that covers a part of a person.
struct Occluder {
  std::uint32_t instance = 0;  ///< as in instances/*.png
  double share = 0;            ///< of the amodal area
};
/// Occluders of a smaller share are left out.
inline constexpr double kMinOccludedShare = 0.0005;

/// Actions of a person in an image (annotate/people/actions.h).
struct ActionLabel {
  std::vector<std::string_view> names;
  /// Agents of the same group nearby, also those whom the image does not show.
  std::vector<std::uint32_t> together_with;
};

struct PersonLabel {
  std::uint32_t agent = 0;
  PixelBox box;               ///< tight bounds of the visible mask
  RunLengths mask;            ///< visible mask
  std::uint64_t area_px = 0;  ///< visible pixels
  double visibility = 0;      ///< area_px / amodal area, in (0, 1]
  /// Amodal box, 3-D position, ...; its amodal area is raised to area_px if below.
  render::PersonInView person;
  std::vector<Keypoint> keypoints;  ///< as skinning::kKeypointNames; empty unless asked for
  std::vector<JointLabel> joints;   ///< as skinning::Joint; empty unless asked for
  std::optional<Difficulty> difficulty = std::nullopt;            ///< none unless asked for
  std::optional<ActionLabel> actions = std::nullopt;              ///< if asked for
  std::optional<HeadLabel> head = std::nullopt;                   ///< none unless asked for
  std::optional<Danger> danger = std::nullopt;                    ///< none unless asked for
  std::optional<std::vector<Occluder>> occluders = std::nullopt;  ///< none unless asked for
};

/// Somebody in view of whom no pixel is visible.
struct HiddenPerson {
  std::uint32_t agent = 0;
  Eigen::AlignedBox2d amodal_box;  ///< box coordinates; reaches into the image
};

/// Another drone or a vehicle in the image.
struct ObjectLabel {
  PixelBox box;               ///< tight bounds of the visible mask
  RunLengths mask;            ///< visible mask
  std::uint64_t area_px = 0;  ///< visible pixels
  double visibility = 0;      ///< area_px / amodal area, in (0, 1]
  render::ObjectInView object;
};

struct FrameLabels {
  std::int64_t frame_index = 0;
  double time_s = 0;
  std::vector<PersonLabel> people;   ///< visible ones (at least one pixel), by agent id
  std::vector<HiddenPerson> hidden;  ///< the others whose amodal box reaches into the image
  std::vector<ObjectLabel> objects;  ///< drones and vehicles, as far as a pixel shows them
};

/// One pass over the id buffer. Everybody who shows there must be in Frame::people (else check()).
FrameLabels label_people(const render::Frame& frame);

/// A mask's runs in COCO's order in an image of this size, which it lies in.
RunLengths run_lengths(const render::PixelMask& mask, int width, int height);

/// COCO's compressed counts string (see docs/formats.md).
std::string coco_counts(const RunLengths& runs);

}  // namespace throng::annotate
