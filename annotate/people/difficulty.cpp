#include "annotate/people/difficulty.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "annotate/people/instance_id.h"
#include "annotate/people/keypoints.h"
#include "annotate/people/lookalikes.h"
#include "annotate/people/visible_mask.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

/// Instances that hide the person, the largest share first.
std::vector<Occluder> find_occluders(const render::Frame& frame, const PersonLabel& label) {
  const render::PixelMask& whole = *label.person.whole_mask;
  const std::uint32_t own = render::id_of_agent(label.agent);
  std::map<std::uint32_t, std::uint64_t> hidden_px;
  for (int y = whole.pixels.min().y(); y < whole.pixels.max().y(); ++y) {
    for (int x = whole.pixels.min().x(); x < whole.pixels.max().x(); ++x) {
      if (!whole.at(x, y)) continue;
      const std::uint32_t id =
          frame.id[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
                   static_cast<std::size_t>(x)];
      if (id != own) ++hidden_px[id];
    }
  }
  std::vector<Occluder> occluders;
  for (const auto& [id, pixels] : hidden_px) {
    const double share =
        static_cast<double>(pixels) / static_cast<double>(label.person.amodal_area_px);
    if (share >= kMinOccludedShare) occluders.push_back({instance_of_id(id), share});
  }
  std::stable_sort(occluders.begin(), occluders.end(),
                   [](const Occluder& a, const Occluder& b) { return a.share > b.share; });
  return occluders;
}

}  // namespace

void add_difficulty(const render::Frame& frame, const ColorImage& image, FrameLabels& labels) {
  const bool has_keypoints =
      std::none_of(labels.people.begin(), labels.people.end(),
                   [](const PersonLabel& label) { return label.keypoints.empty(); });
  FrameLabels own;  // the records have keypoints only if they are asked for
  if (!has_keypoints) {
    own = labels;
    add_keypoints(frame, own);
  }
  const FrameLabels& with_keypoints = has_keypoints ? labels : own;
  std::vector<PersonLook> looks;
  for (std::size_t i = 0; i < labels.people.size(); ++i) {
    PersonLabel& label = labels.people[i];
    const PixelBox& box = label.box;
    const Eigen::Vector2i first(box.x, box.y);
    const render::PixelMask mask =
        visible_mask(frame, render::id_of_agent(label.agent),
                     {first, first + Eigen::Vector2i(box.width, box.height)});
    const Contrast contrast = measure_contrast(image, mask);
    const Eigen::AlignedBox2d& whole = label.person.amodal_box;
    looks.push_back({whole.center(), whole.sizes().y(), describe_look(image, mask)});
    const std::vector<Keypoint>& keypoints = with_keypoints.people[i].keypoints;
    const auto visible =
        std::count_if(keypoints.begin(), keypoints.end(),
                      [](const Keypoint& keypoint) { return keypoint.visibility == 2; });
    label.difficulty =
        Difficulty{contrast.region, contrast.edge, label.person.blur_px, static_cast<int>(visible)};
  }
  const std::vector<std::vector<std::size_t>> lookalikes = group_lookalikes(looks);
  for (std::size_t i = 0; i < labels.people.size(); ++i) {
    for (const std::size_t other : lookalikes[i]) {
      labels.people[i].difficulty->lookalikes.push_back(labels.people[other].agent);
    }
  }
}

void add_occluders(const render::Frame& frame, FrameLabels& labels) {
  for (PersonLabel& label : labels.people) {
    check(label.person.whole_mask != nullptr, "the frame has whole masks");
    label.occluders = find_occluders(frame, label);
  }
}

}  // namespace throng::annotate
