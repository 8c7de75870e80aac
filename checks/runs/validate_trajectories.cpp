// Trajectories of everybody against the people in the images and against how fast people move.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "checks/run_checks.h"
#include "formats/dataset/run_events.h"
#include "formats/dataset/run_trajectories.h"

namespace throng::checks {

using Eigen::Vector2d;

namespace {

constexpr const char* kTrajectoriesRule = "trajectories";
constexpr double kMaxTrackMps = 15;
constexpr double kMaxTrackOffM = 0.01;
constexpr double kMaxOffRad = 0.01;
constexpr double kMaxOffS = 1e-3;
constexpr double kStepS = 0.51;  ///< of the crowd, at most

using Recorded = formats::RunTrajectories;

/// A fault of the values by themselves, or "".
std::string fault_of_values(const Recorded& recorded) {
  for (std::size_t frame = 0; frame < recorded.times_s.size(); ++frame) {
    for (std::size_t person = 0; person < recorded.tracks.size(); ++person) {
      const float* value = recorded.at(frame, person);
      const auto numbers = std::count_if(value, value + formats::kTrajectoryValues,
                                         [](float v) { return !std::isnan(v); });
      const std::string where = fmt::format("track {}, frame {}: ", recorded.tracks[person], frame);
      if (numbers == 0) continue;
      if (numbers < static_cast<std::ptrdiff_t>(formats::kTrajectoryValues) ||
          !std::all_of(value, value + formats::kTrajectoryValues,
                       [](float v) { return std::isfinite(v); })) {
        return where + "values that are no numbers beside others";
      }
      const auto states = static_cast<float>(recorded.states.size());
      if (value[3] < 0 || value[3] != std::floor(value[3]) || value[3] >= std::max(states, 1.0F)) {
        return where + fmt::format("state {}, but there are {}", value[3], recorded.states.size());
      }
      if (frame == 0 || !recorded.present(frame - 1, person)) continue;
      const double passed_s = recorded.times_s[frame] - recorded.times_s[frame - 1];
      const double way_m =
          (recorded.place(frame, person) - recorded.place(frame - 1, person)).norm();
      if (way_m > kMaxTrackMps * passed_s) {
        return where + fmt::format("{:.2f} m in {:g} s", way_m, passed_s);
      }
    }
  }
  return "";
}

/// A frame that is missing or of another time, or "".
std::string fault_of_times(const Recorded& recorded, const formats::DatasetInfo& info) {
  if (static_cast<std::int64_t>(recorded.times_s.size()) != info.frames_per_camera) {
    return fmt::format("{} frames, expected {}", recorded.times_s.size(), info.frames_per_camera);
  }
  for (std::size_t frame = 0; frame < recorded.times_s.size(); ++frame) {
    const double expected_s = info.from_s + static_cast<double>(frame) / info.rate_hz;
    if (std::abs(recorded.times_s[frame] - expected_s) <= kMaxOffS) continue;
    return fmt::format("frame {} at {:g} s, expected {:g} s", frame, recorded.times_s[frame],
                       expected_s);
  }
  return "";
}

/// People of the figures are in the trajectories while they are inside; "" if all are.
std::string fault_of_people(const Recorded& recorded, const nlohmann::json& figures,
                            std::int64_t first_track) {
  const nlohmann::json people = figures.value("by_person", nlohmann::json::object());
  const nlohmann::json agents = people.value("agent", nlohmann::json::array());
  const auto time_of = [&](const char* key, std::size_t i, double otherwise) {
    const auto column = people.find(key);
    const bool is_known = column != people.end() && i < column->size() && (*column)[i].is_number();
    return is_known ? (*column)[i].get<double>() : otherwise;
  };
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::int64_t track = first_track + agents[i].get<std::int64_t>();
    const auto found = std::lower_bound(recorded.tracks.begin(), recorded.tracks.end(), track);
    if (found == recorded.tracks.end() || *found != track) {
      return fmt::format("no track {}, who is in metrics", track);
    }
    const auto person = static_cast<std::size_t>(found - recorded.tracks.begin());
    const double arrived_s = time_of("arrived_s", i, 0);
    constexpr double kNever = 1e9;
    const double left_s =
        std::min({time_of("escaped_s", i, kNever), time_of("vanished_s", i, kNever),
                  time_of("turned_back_s", i, kNever)});
    for (std::size_t frame = 0; frame < recorded.times_s.size(); ++frame) {
      const double time_s = recorded.times_s[frame];
      if (time_s < arrived_s + kMaxOffS || time_s > left_s - kStepS) continue;
      if (recorded.present(frame, person)) continue;
      return fmt::format("track {} is absent at {:g} s, but inside by metrics", track, time_s);
    }
  }
  return "";
}

/// A fault of a person whom an image shows, or "".
std::string fault_of_seen(const Recorded& recorded, std::size_t frame, std::size_t person,
                          const TrajectoriesCheck::Seen& seen) {
  if (!recorded.present(frame, person)) return "absent, but an image shows the person";
  const double off_m = (recorded.place(frame, person) - seen.position).norm();
  if (off_m > kMaxTrackOffM) return fmt::format("{:.2f} m from the position in an image", off_m);
  const float* value = recorded.at(frame, person);
  const auto heading_rad = static_cast<double>(value[2]);
  if (std::abs(geometry::turn_rad(heading_rad, seen.heading_rad)) > kMaxOffRad) {
    return fmt::format("heading {:.2f}, in an image {:.2f}", heading_rad, seen.heading_rad);
  }
  const auto state = static_cast<std::size_t>(value[3]);
  if (seen.behavior.empty() || recorded.states.at(state) == seen.behavior) return "";
  return fmt::format("state \"{}\", in an image \"{}\"", recorded.states[state], seen.behavior);
}

template <typename Report>
void check_frame(const Recorded& recorded, std::size_t number,
                 const TrajectoriesCheck::Frame& frame, const Report& report) {
  if (number >= recorded.times_s.size()) return report("no such frame");
  if (std::abs(recorded.times_s[number] - frame.time_s) > kMaxOffS) {
    report(fmt::format("at {:g} s, in an image at {:g} s", recorded.times_s[number], frame.time_s));
  }
  for (const auto& [track, seen] : frame.people) {
    const auto found = std::lower_bound(recorded.tracks.begin(), recorded.tracks.end(), track);
    if (found == recorded.tracks.end() || *found != track) {
      report(fmt::format("no track {}, which an image shows", track));
      continue;
    }
    const auto person = static_cast<std::size_t>(found - recorded.tracks.begin());
    const std::string what = fault_of_seen(recorded, number, person, seen);
    if (!what.empty()) report(fmt::format("track {}: {}", track, what));
  }
}

}  // namespace

void TrajectoriesCheck::add(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                            Findings& /*findings*/) {
  Frame& frame = runs_[image.run][image.frame];
  frame.time_s = image.time_s;
  if (!is_shot_at_once(image)) return;
  for (const formats::Person& person : image.people) {
    frame.people.insert_or_assign(
        person.track_id,
        Seen{person.position.head<2>(), person.heading_rad, person.record.value("behaviour", "")});
  }
}

void TrajectoriesCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const std::string& run : info.runs) {
    const std::string file = ground_truth_file(annotate::GroundTruth::trajectories, run);
    try {
      const Recorded recorded = formats::read_run_trajectories(info.root, run);
      const std::string wrong_people =
          fault_of_people(recorded, formats::run_figures(info.root, run), first_track(info, run));
      if (!wrong_people.empty()) findings.add(kTrajectoriesRule, file, "", wrong_people);
      const std::string wrong_times = fault_of_times(recorded, info);
      if (!wrong_times.empty()) findings.add(kTrajectoriesRule, file, "", wrong_times);
      const std::string what = fault_of_values(recorded);
      if (!what.empty()) findings.add(kTrajectoriesRule, file, "", what);
      for (const auto& entry : runs_[run]) {
        check_frame(recorded, static_cast<std::size_t>(entry.first), entry.second,
                    [&](const std::string& fault) {
                      findings.add(kTrajectoriesRule, file, fmt::format("frame {}", entry.first),
                                   fault);
                    });
      }
    } catch (const InputError& error) {
      findings.add(kTrajectoriesRule, file, "", error.problems().front().found);
    } catch (const std::exception& error) {
      findings.add(kTrajectoriesRule, file, "", error.what());
    }
  }
}

}  // namespace throng::checks
