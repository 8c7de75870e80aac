// Lists of lookalikes of an image, against each other and against its colors.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "annotate/people/lookalikes.h"
#include "formats/dataset/mask.h"
#include "formats/validate/shot.h"

namespace throng::formats {

namespace {

using Listed = std::map<std::int64_t, std::set<std::int64_t>>;  ///< by track

void check_symmetry(const Shot& shot, const Listed& listed, Findings& findings) {
  for (const Person& person : shot.image.people) {
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

annotate::PersonLook describe_look(const Shot& shot, const Person& person) {
  const Box& box = person.amodal;
  return {{box.x + box.width / 2, box.y + box.height / 2},
          box.height,
          annotate::describe_look({shot.pixels.width, shot.pixels.height, shot.pixels.rgb},
                                  to_pixel_mask(shot.instance_mask(person)))};
}

double heights_between(const annotate::PersonLook& a, const annotate::PersonLook& b) {
  return 2 * (a.center_px - b.center_px).norm() / (a.height_px + b.height_px);
}

/// Compression changes colors of small people, and places are rounded.
bool is_wrong(const annotate::PersonLook& a, const annotate::PersonLook& b, bool is_listed,
              double slack) {
  constexpr double kSlackHeights = 0.15;
  const double difference = annotate::look_difference(*a.look, *b.look);
  const double heights = heights_between(a, b);
  return is_listed ? difference > annotate::kMaxLookDifference + slack ||
                         heights > annotate::kMaxLookalikeHeights + kSlackHeights
                   : difference < annotate::kMaxLookDifference - slack &&
                         heights < annotate::kMaxLookalikeHeights - kSlackHeights;
}

void check_colors(const Shot& shot, const std::vector<annotate::PersonLook>& looks,
                  const Listed& listed, Findings& findings) {
  constexpr double kMinAreaPx = 80;
  const std::vector<Person>& people = shot.image.people;
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = i + 1; j < people.size(); ++j) {
      const annotate::PersonLook& a = looks[i];
      const annotate::PersonLook& b = looks[j];
      const bool is_listed = listed.at(people[i].track_id).contains(people[j].track_id);
      if (std::min(people[i].area, people[j].area) < kMinAreaPx || !a.look || !b.look ||
          !is_wrong(a, b, is_listed, compression_slack(shot.image))) {
        continue;
      }
      findings.add("lookalikes", people[i],
                   fmt::format("lookalikes {} {}: colors differ by {:.1f}, {:.1f} heights away",
                               is_listed ? "has" : "lacks", people[j].track_id,
                               annotate::look_difference(*a.look, *b.look), heights_between(a, b)));
      return;
    }
  }
}

/// Compression makes small people more alike than they were, but not all of many.
void check_existence(const Shot& shot, const std::vector<annotate::PersonLook>& looks,
                     const Listed& listed, Findings& findings) {
  constexpr std::ptrdiff_t kMinExpected = 8;
  constexpr double kMaxSlack = 4;  // of quality 90
  const double slack = compression_slack(shot.image);
  const bool lists_any = std::any_of(listed.begin(), listed.end(),
                                     [](const auto& entry) { return !entry.second.empty(); });
  if (lists_any || slack > kMaxSlack) return;
  const auto looks_like_others = [&](const annotate::PersonLook& a) {
    return a.look && std::any_of(looks.begin(), looks.end(), [&](const annotate::PersonLook& b) {
             return &a != &b && b.look && is_wrong(a, b, false, slack);
           });
  };
  const std::ptrdiff_t expected_people =
      std::count_if(looks.begin(), looks.end(), looks_like_others);
  if (expected_people < kMinExpected) return;
  findings.add(
      "lookalikes", kCocoFile, shot.record(),
      fmt::format("nobody has lookalikes, but {} people have in the image", expected_people));
}

}  // namespace

void check_lookalikes(const Shot& shot, Findings& findings) {
  Listed listed;
  for (const Person& person : shot.image.people) {
    const auto difficulty = person.record.find("difficulty");
    if (difficulty == person.record.end() || !difficulty->contains("lookalikes")) return;
    listed[person.track_id] = difficulty->at("lookalikes").get<std::set<std::int64_t>>();
  }
  check_symmetry(shot, listed, findings);
  if (shot.pixels.rgb.empty()) return;
  std::vector<annotate::PersonLook> looks;
  for (const Person& person : shot.image.people) looks.push_back(describe_look(shot, person));
  check_colors(shot, looks, listed, findings);
  check_existence(shot, looks, listed, findings);
}

}  // namespace throng::formats
