// Events against the people whom images show: where they are, and that they are there at all.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "checks/door_checks.h"
#include "checks/run_checks.h"
#include "formats/dataset/run_events.h"

namespace throng::checks {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kEventsRule = "events";
constexpr double kMaxPersonMps = 15;
constexpr double kMaxEventOffM = 0.05;
constexpr double kFrameSlackS = 1e-4;

using Frames = EventsCheck::Frames;

/// Times of frames, ascending, with their numbers.
using FrameTimes = std::vector<std::pair<double, std::int64_t>>;

FrameTimes frame_times(const Frames& frames) {
  FrameTimes times;
  times.reserve(frames.size());
  for (const auto& [number, frame] : frames) times.emplace_back(frame.time_s, number);
  std::sort(times.begin(), times.end());
  return times;
}

/// The last frame that is not after a time.
std::optional<std::int64_t> frame_at(const FrameTimes& times, double time_s) {
  const auto next = std::upper_bound(times.begin(), times.end(), time_s + kFrameSlackS,
                                     [](double at, const auto& frame) { return at < frame.first; });
  if (next == times.begin()) return std::nullopt;
  return std::prev(next)->second;
}

/// A fault of an event's place, seen from a frame near to it, or "".
std::string fault_of_place(const formats::RunEvent& event, const EventsCheck::Frame& frame) {
  const auto track = event.record.find("track_id");
  const auto position = event.record.find("position");
  if (track == event.record.end() || position == event.record.end()) return "";
  const auto seen = frame.people.find(track->get<std::int64_t>());
  if (seen == frame.people.end()) return "";
  const Eigen::Vector2d place(position->at(0).get<double>(), position->at(1).get<double>());
  const double off_m = (place - seen->second).norm();
  const double passed_s = std::abs(event.time_s - frame.time_s);
  if (off_m <= kMaxEventOffM + kMaxPersonMps * passed_s) return "";
  return fmt::format("{:.2f} m from where an image shows the person {:.3f} s away", off_m,
                     passed_s);
}

template <typename Report>
void check_order(const std::vector<formats::RunEvent>& events, const Frames& frames,
                 const Report& report) {
  const FrameTimes times = frame_times(frames);
  double before_s = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const formats::RunEvent& event = events[i];
    if (event.time_s < before_s)
      report(i, fmt::format("at {} s, after {} s", event.time_s, before_s));
    before_s = event.time_s;
    const auto frame = frame_at(times, event.time_s);
    const json expected = frame ? json(*frame) : json();
    if (event.record.value("frame", json()) != expected) {
      report(i, fmt::format("frame {}, but the last one not after {} s is {}",
                            event.record.value("frame", json()).dump(), event.time_s,
                            expected.dump()));
    }
    if (!frame) continue;
    for (auto near = frames.find(*frame); near != frames.end() && near->first <= *frame + 1;
         ++near) {
      const std::string fault = fault_of_place(event, near->second);
      if (!fault.empty()) report(i, fault);
    }
  }
}

/// Nobody is seen who has departed or has not arrived.
template <typename Report>
void check_presence(const std::vector<formats::RunEvent>& events, const Frames& frames,
                    const Report& report) {
  std::map<std::int64_t, std::vector<std::size_t>> changes;  // by track
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].type != "arrives" && events[i].type != "departs") continue;
    changes[events[i].record.at("track_id").get<std::int64_t>()].push_back(i);
  }
  for (const auto& [number, frame] : frames) {
    for (const auto& [track, place] : frame.people) {
      const auto known = changes.find(track);
      if (known == changes.end()) continue;
      bool is_here = events[known->second.front()].type == "departs";
      std::size_t last = known->second.front();
      for (const std::size_t change : known->second) {
        // A step of the crowd lies between the last moment of presence and the event.
        const bool arrives = events[change].type == "arrives";
        constexpr double kStepS = 0.11;
        const double from_s = arrives ? events[change].time_s - kStepS : events[change].time_s;
        if (frame.time_s <= from_s + kFrameSlackS) break;
        is_here = arrives;
        last = change;
      }
      if (!is_here) {
        report(last,
               fmt::format("track {} is away then, but frame {} shows the person", track, number));
      }
    }
  }
}

}  // namespace

void EventsCheck::add(const formats::DatasetInfo& /*info*/, const formats::Image& image,
                      Findings& /*findings*/) {
  Frame& frame = runs_[image.run][image.frame];
  frame.time_s = image.time_s;
  if (!is_shot_at_once(image)) return;
  for (const formats::Person& person : image.people) {
    frame.people.insert_or_assign(person.track_id, person.position.head<2>());
  }
}

void EventsCheck::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const std::string& run : info.runs) {
    const std::string file = ground_truth_file(annotate::GroundTruth::events, run);
    try {
      const std::vector<formats::RunEvent> events = formats::read_run_events(info.root, run);
      const auto report = [&](std::size_t event, const std::string& fault) {
        const std::string line =
            event == formats::kNoEvent ? "" : fmt::format("line {}", event + 1);
        findings.add(kEventsRule, file, line, fault);
      };
      formats::check_event_records(events, report);
      const json figures = formats::run_figures(info.root, run);
      const std::int64_t first = formats::first_track(info, run);
      formats::check_events_against_figures(events, figures, first, report);
      check_closures(info.root, run, events, figures, report);
      check_escape_exits(info.root, run, events, figures, first, report);
      if (info.has(annotate::GroundTruth::trajectories)) {
        formats::check_events_against_trajectories(
            events, formats::read_run_trajectories(info.root, run), report);
      }
      check_order(events, runs_[run], report);
      check_presence(events, runs_[run], report);
    } catch (const InputError& error) {
      findings.add(kEventsRule, file, "", error.problems().front().found);
    } catch (const std::exception& error) {
      findings.add(kEventsRule, file, "", error.what());
    }
  }
}

}  // namespace throng::checks
