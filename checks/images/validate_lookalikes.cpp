// Lists of lookalikes of an image, against each other and against its colors.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "annotate/people/lookalikes.h"
#include "checks/shot.h"
#include "formats/dataset/mask.h"

namespace throng::checks {

namespace {

using Listed = std::map<std::int64_t, std::set<std::int64_t>>;  ///< by track

void check_symmetry(const Shot& shot, const Listed& listed, Findings& findings) {
  for (const formats::Person& person : shot.image.people) {
    for (const std::int64_t other : listed.at(person.track_id)) {
      const auto found = listed.find(other);
      if (other != person.track_id && found != listed.end() &&
          found->second.contains(person.track_id)) {
        continue;
      }
      findings.add("lookalikes", person,
                   fmt::format("lookalikes has {}, but {}", other,
                               other == person.track_id ? "a person is not their own"
                               : found == listed.end()  ? "that track is not in the image"
                                                        : "that track does not list this one"));
      return;
    }
  }
}

annotate::PersonLook describe_look(const Shot& shot, const formats::Person& person) {
  const formats::Box& box = person.amodal;
  return {{box.x + box.width / 2, box.y + box.height / 2},
          box.height,
          annotate::describe_look({shot.pixels.width, shot.pixels.height, shot.pixels.rgb},
                                  formats::to_pixel_mask(shot.instance_mask(person)))};
}

double heights_between(const annotate::PersonLook& a, const annotate::PersonLook& b) {
  return 2 * (a.center_px - b.center_px).norm() / (a.height_px + b.height_px);
}

/// Both looks are means over the same pixels of the same image; boxes in records are rounded.
bool is_wrong(const annotate::PersonLook& a, const annotate::PersonLook& b, bool is_listed) {
  constexpr double kSumsSlack = 0.01;
  constexpr double kRoundingPx = 0.1;
  const double slack_heights = kRoundingPx / std::max(1.0, std::min(a.height_px, b.height_px));
  const double difference = annotate::look_difference(*a.look, *b.look);
  const double heights = heights_between(a, b);
  return is_listed ? difference > annotate::kMaxLookDifference + kSumsSlack ||
                         heights > annotate::kMaxLookalikeHeights + slack_heights
                   : difference < annotate::kMaxLookDifference - kSumsSlack &&
                         heights < annotate::kMaxLookalikeHeights - slack_heights;
}

void check_colors(const Shot& shot, const std::vector<annotate::PersonLook>& looks,
                  const Listed& listed, Findings& findings) {
  const std::vector<formats::Person>& people = shot.image.people;
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = i + 1; j < people.size(); ++j) {
      const annotate::PersonLook& a = looks[i];
      const annotate::PersonLook& b = looks[j];
      const bool is_listed = listed.at(people[i].track_id).contains(people[j].track_id);
      const bool have_looks = a.look && b.look;
      if (have_looks ? !is_wrong(a, b, is_listed) : !is_listed) continue;
      findings.add(
          "lookalikes", people[i],
          fmt::format("lookalikes {} {}: {}", is_listed ? "has" : "lacks", people[j].track_id,
                      have_looks ? fmt::format("colors differ by {:.1f}, {:.1f} heights away",
                                               annotate::look_difference(*a.look, *b.look),
                                               heights_between(a, b))
                                 : "too few pixels show them"));
      return;
    }
  }
}

}  // namespace

void check_lookalikes(const Shot& shot, Findings& findings) {
  Listed listed;
  for (const formats::Person& person : shot.image.people) {
    const auto difficulty = person.record.find("difficulty");
    if (difficulty == person.record.end() || !difficulty->contains("lookalikes")) return;
    listed[person.track_id] = difficulty->at("lookalikes").get<std::set<std::int64_t>>();
  }
  check_symmetry(shot, listed, findings);
  if (shot.pixels.rgb.empty() || !shot.has_final_contrasts) return;
  std::vector<annotate::PersonLook> looks;
  for (const formats::Person& person : shot.image.people)
    looks.push_back(describe_look(shot, person));
  check_colors(shot, looks, listed, findings);
}

}  // namespace throng::checks
