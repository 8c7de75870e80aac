// People whom no image shows, by the trajectories: everybody in a camera's view has a record, and
// headings and states of the unseen are like those of the seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "checks/run_checks.h"
#include "checks/shares.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/run_trajectories.h"
#include "world/trace.h"

namespace throng::checks {

using Eigen::Vector2d;

namespace {

/// Frames farther apart say little about headings and states.
constexpr double kNeighborFramesS = 1.1;

/// Whether the ground at a place is inside of the image, by so much that a body there reaches into
/// it whatever its pose.
bool must_reach(const UnseenCheck::View& view, const Vector2d& place) {
  const Eigen::Vector3d ground(place.x(), place.y(), 0);
  const camera::Camera::Projection seen = view.camera.project(ground);
  constexpr double kNearM = 1;
  constexpr double kBodyM = 0.7;
  if (!seen.visible || seen.depth_m < kNearM) return false;
  const double margin_px = 2 + formats::pixels_across(view.camera, ground, kBodyM);
  const camera::Intrinsics& image = view.camera.intrinsics;
  return seen.pixel.x() > margin_px && seen.pixel.y() > margin_px &&
         seen.pixel.x() < image.width - margin_px && seen.pixel.y() < image.height - margin_px;
}

/// Samples of people in consecutive frames, apart by whether images show them.
class UnseenRun {
 public:
  UnseenRun(const formats::RunTrajectories& recorded,
            const std::map<std::int64_t, UnseenCheck::Frame>& frames)
      : recorded_(recorded),
        frames_(frames),
        stand_states_(world::find_stand_states(recorded.states).value_or(recorded.states.size())) {}

  /// Somebody without a record whom a camera must see: a text, or "".
  std::string left_out(std::string& record) const {
    for (const auto& [number, frame] : frames_) {
      const auto index = static_cast<std::size_t>(number);
      if (index >= recorded_.times_s.size()) continue;
      for (const UnseenCheck::View& view : frame.views) {
        for (std::size_t person = 0; person < recorded_.tracks.size(); ++person) {
          const std::int64_t track = recorded_.tracks[person];
          if (!recorded_.present(index, person) || view.tracks.contains(track) ||
              is_on_stand(index, person) || !must_reach(view, recorded_.place(index, person))) {
            continue;
          }
          record = fmt::format("image {}", view.image);
          return fmt::format(
              "track {} is at ({:.1f}, {:.1f}) by the trajectories, within the image, but neither "
              "has an annotation nor is among the hidden",
              track, recorded_.place(index, person).x(), recorded_.place(index, person).y());
        }
      }
    }
    return "";
  }

  void look() {
    for (std::size_t frame = 0; frame + 1 < recorded_.times_s.size(); ++frame) {
      const double passed_s = recorded_.times_s[frame + 1] - recorded_.times_s[frame];
      if (passed_s > kNeighborFramesS) continue;
      for (std::size_t person = 0; person < recorded_.tracks.size(); ++person) {
        if (recorded_.present(frame, person) && recorded_.present(frame + 1, person)) {
          look_at(frame, person, passed_s);
        }
      }
    }
  }

  /// People who walk look where they go, seen or not.
  bool have_other_headings() const {
    constexpr double kMaxShare = 0.2;
    return is_above_share(unseen_headings.wrong, unseen_headings.looked_at,
                          std::max(kMaxShare, 2 * seen_headings.share()));
  }
  /// States last: people who come into view, or leave it, have the state that they had.
  bool have_other_states() const {
    constexpr double kMaxShare = 0.4;
    return is_above_share(border_states.wrong, border_states.looked_at,
                          std::max(kMaxShare, 2 * seen_states.share()), 1);
  }

  /// A state in which the seen stand and the unseen walk, or the reverse; "" if there is none.
  std::string state_of_other_motion() const {
    constexpr std::size_t kMinCount = 20;
    constexpr double kNearlyAll = 0.95;
    constexpr double kMinority = 0.4;
    for (const auto& [state, seen] : seen_motion_) {
      const auto unseen = unseen_motion_.find(state);
      if (unseen == unseen_motion_.end() || seen.looked_at < kMinCount ||
          unseen->second.looked_at < kMinCount) {
        continue;
      }
      const bool stand = seen.share() > kNearlyAll && unseen->second.share() < kMinority;
      const bool walk = seen.share() < 1 - kNearlyAll && unseen->second.share() > 1 - kMinority;
      if (stand || walk) return recorded_.states.at(static_cast<std::size_t>(state));
    }
    return "";
  }

  WrongTally seen_headings;
  WrongTally unseen_headings;
  WrongTally seen_states;
  WrongTally border_states;  ///< of people who are seen in one of two frames

 private:
  /// Whether somebody is on a stand, above the ground by an unknown height.
  bool is_on_stand(std::size_t frame, std::size_t person) const {
    return recorded_.at(frame, person)[3] >= static_cast<float>(stand_states_) &&
           stand_states_ < recorded_.states.size();
  }
  bool is_seen(std::size_t frame, std::size_t person) const {
    const auto found = frames_.find(static_cast<std::int64_t>(frame));
    return found != frames_.end() && found->second.seen.contains(recorded_.tracks[person]);
  }

  void look_at(std::size_t frame, std::size_t person, double passed_s) {
    const bool before = is_seen(frame, person);
    const bool after = is_seen(frame + 1, person);
    const float* then = recorded_.at(frame, person);
    const float* now = recorded_.at(frame + 1, person);
    const bool is_other = then[3] != now[3];
    if (before && after) seen_states.add(is_other);
    if (before != after) border_states.add(is_other);
    const Vector2d way = recorded_.place(frame + 1, person) - recorded_.place(frame, person);
    constexpr double kStandingMps = 0.2;
    if (before == after && !is_other) {
      (before ? seen_motion_ : unseen_motion_)[then[3]].add(way.norm() < kStandingMps * passed_s);
    }
    constexpr double kWalkingMps = 0.6;
    constexpr double kMinWayM = 0.1;
    if (way.norm() < std::max(kMinWayM, kWalkingMps * passed_s) || before != after) return;
    constexpr double kAsideRad = 75 * kDegree;
    const double heading_rad = std::atan2(way.y(), way.x());
    const auto is_aside = [&](const float* value) {
      return std::abs(geometry::turn_rad(static_cast<double>(value[2]), heading_rad)) > kAsideRad;
    };
    (before ? seen_headings : unseen_headings).add(is_aside(then) && is_aside(now));
  }

  const formats::RunTrajectories& recorded_;
  const std::map<std::int64_t, UnseenCheck::Frame>& frames_;
  std::size_t stand_states_;                 ///< first of those of people on stands
  std::map<float, WrongTally> seen_motion_;  ///< share of people who stand, by state
  std::map<float, WrongTally> unseen_motion_;
};

}  // namespace

void UnseenCheck::add(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                      Findings& /*findings*/) {
  Frame& frame = runs_[image.run][image.frame];
  View view{image.id, formats::image_camera(image), {}};
  for (const formats::Person& person : image.people) {
    frame.seen.insert(person.track_id);
    view.tracks.insert(person.track_id);
  }
  for (const formats::HiddenPerson& person : image.hidden) view.tracks.insert(person.track_id);
  if (is_shot_at_once(image)) frame.views.push_back(std::move(view));
}

void UnseenCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const auto& [name, frames] : runs_) {
    const std::string file = ground_truth_file(annotate::GroundTruth::trajectories, name);
    try {
      const formats::RunTrajectories recorded = formats::read_run_trajectories(info.root, name);
      UnseenRun run(recorded, frames);
      std::string record;
      const std::string left_out = run.left_out(record);
      if (!left_out.empty()) findings.add("nobody-left-out", formats::kCocoFile, record, left_out);
      run.look();
      if (run.have_other_headings()) {
        findings.add("trajectories", file, "",
                     fmt::format("{} of {} headings of people who walk unseen are not where they "
                                 "go",
                                 run.unseen_headings.wrong, run.unseen_headings.looked_at));
      }
      if (const std::string state = run.state_of_other_motion(); !state.empty()) {
        findings.add("trajectories", file, "",
                     fmt::format("the unseen do not move in state \"{}\" as the seen do", state));
      }
      if (run.have_other_states()) {
        findings.add("trajectories", file, "",
                     fmt::format("{} of {} states change where people come into view or leave it, "
                                 "{} of {} while they are seen",
                                 run.border_states.wrong, run.border_states.looked_at,
                                 run.seen_states.wrong, run.seen_states.looked_at));
      }
    } catch (const std::exception&) {
      // TrajectoriesCheck reports a file that cannot be read.
    }
  }
}

}  // namespace throng::checks
