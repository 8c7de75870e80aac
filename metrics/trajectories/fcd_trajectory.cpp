// Floating car data of SUMO, which has persons, too.
#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/error.h"
#include "metrics/trajectories/number_in.h"
#include "metrics/trajectories/other_formats.h"
#include "metrics/trajectories/table_fields.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/timed_tracks.h"

namespace throng::metrics {

namespace {

class FcdReader {
 public:
  explicit FcdReader(const std::string& name) : name_(name) {}

  TimedPeople read(const tinyxml2::XMLElement& root) {
    for (const auto* step = root.FirstChildElement("timestep"); step != nullptr;
         step = step->NextSiblingElement("timestep")) {
      const double time_s = time(*step);
      for (const auto* entry = step->FirstChildElement(); entry != nullptr;
           entry = entry->NextSiblingElement()) {
        if (std::string_view(entry->Name()) == "person") read_person(*entry, time_s);
        if (std::string_view(entry->Name()) == "vehicle") ++vehicles_;
      }
    }
    if (people_.tracks.empty()) {
      reject(root, fmt::format("no <person> but {} entries of vehicles", vehicles_),
             "persons in the time steps");
    }
    refuse_degrees();
    return std::move(people_);
  }

 private:
  void read_person(const tinyxml2::XMLElement& entry, double time_s) {
    const char* id = entry.Attribute("id");
    if (id == nullptr) reject(entry, "a person without id", "an attribute \"id\"");
    const auto [known, is_new] = numbers_.try_emplace(id, people_.tracks.size());
    if (is_new) {
      people_.ids.push_back(static_cast<std::int64_t>(people_.tracks.size()) + 1);
      people_.tracks.emplace_back();
      speeds_.emplace_back();
    }
    const Eigen::Vector2d place(number(entry, "x"), number(entry, "y"));
    if (!people_.tracks[known->second].try_emplace(time_s, place).second) {
      reject(entry, fmt::format("person {} again", shown(id)), "each person once at a time");
    }
    if (entry.Attribute("speed") != nullptr) {
      speeds_[known->second][time_s] = number(entry, "speed");
    }
  }

  double time(const tinyxml2::XMLElement& step) const {
    const char* text = step.Attribute("time");
    const auto parsed = text == nullptr ? std::nullopt : field_time(text);
    if (!parsed) reject(step, text == nullptr ? "no time" : shown(text), "a time in s");
    return parsed->value;
  }

  double number(const tinyxml2::XMLElement& entry, const char* attribute) const {
    const char* text = entry.Attribute(attribute);
    const auto value = text == nullptr ? std::nullopt : number_in(text);
    if (!value) {
      reject(entry, text == nullptr ? fmt::format("no \"{}\"", attribute) : shown(text),
             fmt::format("a number \"{}\"", attribute));
    }
    return *value;
  }

  /// Degrees show in distances that are tiny compared with the stated speeds.
  void refuse_degrees() const {
    constexpr double kFewMeters = 1;
    constexpr double kTinyShare = 0.01;
    double walked = 0;
    double expected = 0;
    for (std::size_t i = 0; i < people_.tracks.size(); ++i) {
      const Track& track = people_.tracks[i];
      for (auto now = track.begin(); std::next(now) != track.end(); ++now) {
        const auto next = std::next(now);
        const auto speed = speeds_[i].find(next->first);
        if (speed == speeds_[i].end()) continue;
        walked += (next->second - now->second).norm();
        expected += speed->second * (next->first - now->first);
      }
    }
    if (expected < kFewMeters || walked > kTinyShare * expected) return;
    throw InputError({name_, "", "longitudes and latitudes, by the persons' speeds",
                      "places in m: FCD output without --fcd-output.geo"});
  }

  [[noreturn]] void reject(const tinyxml2::XMLElement& element, const std::string& found,
                           const std::string& expected) const {
    throw InputError(
        {name_, fmt::format("line {}, element <{}>", element.GetLineNum(), shown(element.Name())),
         found, expected});
  }

  const std::string& name_;
  TimedPeople people_;
  std::vector<std::map<double, double>> speeds_;  // m/s, by time, of each track
  std::map<std::string, std::size_t> numbers_;
  std::size_t vehicles_ = 0;
};

}  // namespace

Recorded read_fcd(std::string_view text, const std::string& name,
                  std::optional<double> frames_per_s) {
  if (text.find("<!ENTITY") != std::string_view::npos) {
    throw InputError({name, "", "a declaration of an entity", "FCD output of SUMO"});
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError({name, fmt::format("line {}", std::max(1, document.ErrorLineNum())),
                      "text that cannot be parsed", "well-formed XML"});
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "fcd-export") {
    throw InputError({name, "",
                      root == nullptr ? "no element" : fmt::format("<{}>", shown(root->Name())),
                      "the root <fcd-export> of SUMO's FCD output"});
  }
  Recorded recorded = put_on_frames(FcdReader(name).read(*root), frames_per_s, name);
  recorded.unit_is_stated = true;
  return recorded;
}

}  // namespace throng::metrics
