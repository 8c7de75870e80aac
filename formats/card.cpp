#include "formats/card.h"
#include "base/text/markup.h"
#include "base/text/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>

#include "formats/dataset/class_mappings.h"
#include "spec/annotate/ground_truth.h"
#include "spec/annotate/license.h"
#include "world/semantic_class.h"

namespace throng::formats {

using nlohmann::json;

namespace {

constexpr int kCardVersion = 1;
/// The license of the characters that set-up bakes; imported ones have licenses of their own.
constexpr const char* kPeopleLicense =
    "CC0-1.0 for those that throng people build makes; see NOTICE.txt beside the character library";

/// Grounds, walls, sky and props are drawn from formulas.
constexpr const char* kPlaceLicense =
    "no third party's: textures and shapes are computed; mesh files of a scenario have their own";

/// "00016-00032": the class of a value between two borders, in names that sort.
std::string band_name(double value, std::span<const int> borders) {
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    if (value < borders[i + 1]) return fmt::format("{:05}-{:05}", borders[i], borders[i + 1]);
  }
  return fmt::format("{:05}-", borders.back());
}

std::string light_name(const json& record) {
  const auto environment = record.find("environment");
  if (environment == record.end() || !environment->contains("sun_elevation_deg")) return "unknown";
  constexpr double kCivilDeg = -6;
  constexpr double kLowDeg = 10;
  const double elevation = environment->at("sun_elevation_deg");
  if (elevation < kCivilDeg) return "night";
  if (elevation < 0) return "twilight";
  return elevation < kLowDeg ? "low sun" : "day";
}

std::string weather_name(const json& record) {
  const auto environment = record.find("environment");
  return environment == record.end() ? "unknown" : environment->value("weather", "unknown");
}

/// The place of a kind of ground truth, and its content.
std::string folder_column(const annotate::GroundTruthKind& kind) {
  return kind.content.empty() ? std::string(kind.file)
                              : fmt::format("{}: {}", kind.file, kind.content);
}

/// The legend of semantic/.
json semantic_legend() {
  json classes = json::array();
  for (const world::SemanticClassInfo& known : world::semantic_classes()) {
    classes.push_back({{"id", static_cast<int>(known.value)},
                       {"name", known.name},
                       {"color", known.color},
                       {"cityscapes", cityscapes_class(known.value).name},
                       {"uavid", uavid_class(known.value).name}});
  }
  return classes;
}

constexpr std::string_view kCocoSnippet = R"(
## Loading

Boxes, masks, cameras and tracks, with nothing but Python's standard library:

```python
import json

coco = json.load(open("annotations/instances.json"))
tracks = {track["id"]: track for track in coco["tracks"]}
people = {}
for annotation in coco["annotations"]:
    people.setdefault(annotation["image_id"], []).append(annotation)
for image in coco["images"]:
    boxes = [person["bbox"] for person in people.get(image["id"], [])]
    hats = [tracks[person["track_id"]]["attributes"]["wears"] for person in people.get(image["id"], [])]
    print(image["file_name"], len(boxes), "people,", sum("hat" in wears for wears in hats), "with hats")
```
)";

constexpr std::string_view kDensitySnippet = R"(
A density map and its count, with NumPy:

```python
import json
import numpy

image = json.load(open("annotations/instances.json"))["images"][0]
density = numpy.load(image["density_file"])["density"]
assert abs(density.sum(dtype=numpy.float64) - image["density_count"]) < 0.01 * max(1, image["density_count"])
```
)";

constexpr std::string_view kProjectionSnippet = R"(
The position of a person in the image (of a camera without distortion):

```python
import json
import numpy

coco = json.load(open("annotations/instances.json"))
images = {image["id"]: image for image in coco["images"]}
for person in coco["annotations"][:10]:
    camera = images[person["image_id"]]["camera"]
    point = numpy.array(camera["R"]) @ person["position"] + camera["t"]
    u, v = (numpy.array(camera["K"]) @ point)[:2] / point[2] + 0.5  # box coordinates
```
)";

}  // namespace

DatasetCard::DatasetCard(const DatasetInfo& info, json manifest, Output output)
    : info_(info), manifest_(std::move(manifest)), output_(std::move(output)) {}

void DatasetCard::add(const Image& image) {
  constexpr std::array kHeights = {0, 8, 16, 32, 64, 128, 256};
  constexpr std::array kCounts = {0, 1, 10, 50, 100, 200, 500, 1000};
  constexpr int kPercent = 100;
  constexpr std::array kShares = {0, 10, 25, 50, 75, 90};
  constexpr double kTruncated = 0.005;
  ++images_;
  people_ += static_cast<std::int64_t>(image.people.size());
  max_in_image_ = std::max(max_in_image_, static_cast<std::int64_t>(image.people.size()));
  ++by_count_[band_name(static_cast<double>(image.people.size()), kCounts)];
  ++by_light_[light_name(image.record)];
  ++by_weather_[weather_name(image.record)];
  ++by_split_[std::string(to_string(image.split))];
  for (const Person& object : image.objects) {
    ++objects_[info_.object_categories.at(object.category - info_.categories.size()).id];
  }
  for (const Person& person : image.people) {
    ++by_height_[band_name(person.amodal.height, kHeights)];
    ++by_visibility_[band_name(kPercent * person.visibility, kShares)];
    ++by_state_[person.state.empty() ? "unknown" : person.state];
    truncated_ += person.truncation >= kTruncated ? 1 : 0;
    ignored_ += person.is_ignored ? 1 : 0;
    if (tracks_.insert(person.track_id).second) add_character(person);
  }
}

void DatasetCard::add_character(const Person& person) {
  if (!person.track) return;
  const auto attributes = person.track->find("attributes");
  if (attributes == person.track->end()) return;
  const auto character = attributes->find("character");
  if (character != attributes->end()) characters_.insert(character->get<std::string>());
}

std::int64_t DatasetCard::count_annotations(int category) const {
  const auto found = objects_.find(category);
  return found == objects_.end() ? 0 : found->second;
}

json DatasetCard::classes() const {
  json names = {{std::to_string(annotate::kPersonCategory), "person"}};
  for (const annotate::ObjectCategory& category : info_.object_categories) {
    names[std::to_string(category.id)] = category.name;
  }
  return names;
}

json DatasetCard::statistics() const {
  json figures = {{"images", images_},
                  {"annotations", people_},
                  {"annotations_of_drones", count_annotations(annotate::kDroneCategory)},
                  {"most_people_in_an_image", max_in_image_},
                  {"distinct_characters", characters_.size()},
                  {"truncated", truncated_},
                  {"fail_the_filters", ignored_},
                  {"annotations_by_height_px", by_height_},
                  {"annotations_by_visibility_percent", by_visibility_},
                  {"annotations_by_state", by_state_},
                  {"images_by_people", by_count_},
                  {"images_by_light", by_light_},
                  {"images_by_weather", by_weather_},
                  {"images_by_split", by_split_}};
  for (const annotate::ObjectCategory& category : info_.object_categories) {
    if (category.id == annotate::kDroneCategory) continue;
    figures["annotations_of_vehicles"][std::string(category.name)] = count_annotations(category.id);
  }
  return figures;
}

json DatasetCard::description() const {
  json places_here = {
      {"images", "images/RUN/CAMERA/FRAME.jpg"},
      {"metrics", "metrics.json"},
      {"cameras",
       "cameras/RUN/CAMERA.opencv.yaml and .ros.yaml; .mask.png: 0 where the lens shows nothing"},
      {"files", "manifest.json: size and SHA-256 of each file"}};
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    if (info_.has(kind.kind)) places_here[std::string(kind.name)] = folder_column(kind);
  }
  json formats = json::object();
  for (const json& name : manifest_.at("job").at("outputs").value("formats", json::array())) {
    formats[name.get<std::string>()] = "formats/" + name.get<std::string>();
  }
  json splits = json::object();
  json seeds = json::object();
  json scenarios = json::object();
  for (const json& run : manifest_.at("runs")) {
    const std::string name = run.at("run");
    splits[std::string(to_string(info_.split_of(name)))].push_back(name);
    seeds[name] = run.value("seed", json());
    if (run.contains("scenario")) scenarios[name] = run["scenario"];
  }
  json card = {
      {"schema_version", kCardVersion},
      {"name", info_.name},
      {"generator", info_.generator},
      {"schema_versions",
       {{"manifest", manifest_.at("schema_version")}, {"coco", annotate::kLabelVersion}}},
      {"files", places_here},
      {"classes", classes()},
      {"formats", formats},
      {"splits", splits},
      {"seeds", seeds},
      {"scenarios", scenarios},
      {"statistics", statistics()},
      {"conventions",
       {{"boxes", "origin at the top left corner of the top left pixel; pixel i covers [i, i+1)"},
        {"projection",
         "OpenCV's pixels: u = K (R X + t), divided by its third part; + 0.5 in "
         "box coordinates"},
        {"world", "right-handed, meters, z up, the ground is z = 0"},
        {"camera", "x right, y down, z forward"},
        {"time", "seconds since the run began; label and image are of the same instant"}}},
      {"licence",
       {{"images", annotate::kImageLicense}, {"people", kPeopleLicense}, {"place", kPlaceLicense}}},
      {"people", manifest_.value("people", json::object())},
      {"job", manifest_.at("job")}};
  if (info_.has(annotate::GroundTruth::semantic)) card["semantic_classes"] = semantic_legend();
  return card;
}

std::string DatasetCard::readme() const {
  std::string text = fmt::format(
      "# {}\n\nA synthetic crowd dataset made by {}: {} with {} of people, of {}, in "
      "{}.\n`dataset.json` describes it, `manifest.json` lists every file "
      "with its SHA-256. `throng validate` checks it.\n\n",
      escaped_markdown(info_.name), escaped_markdown(info_.generator), counted(images_, "image"),
      counted(people_, "annotation"),
      counted(static_cast<std::int64_t>(characters_.size()), "distinct character"),
      info_.runs.size() == 1 ? "one run" : fmt::format("{} runs", info_.runs.size()));
  text += "| what | where |\n|---|---|\n";
  const json card = description();
  for (const auto& [kind, place] : card.at("files").items()) {
    text += fmt::format("| {} | {} |\n", kind, place.get<std::string>());
  }
  for (const auto& [name, place] : card.at("formats").items()) {
    text += fmt::format("| format {} | {}/ |\n", name, place.get<std::string>());
  }
  text += kCocoSnippet;
  if (info_.has(annotate::GroundTruth::density)) text += kDensitySnippet;
  text += kProjectionSnippet;
  text += fmt::format(
      "\n## Splits\n\nWhole runs: {}.\n\n## License\n\nImages and labels: {}. People: {}. Place: "
      "{}.\n",
      card.at("splits").dump(), annotate::kImageLicense, kPeopleLicense, kPlaceLicense);
  return text;
}

void DatasetCard::finish() {
  constexpr int kIndent = 2;
  output_.write("dataset.json", description().dump(kIndent) + "\n");
  output_.write("README.md", readme());
}

}  // namespace throng::formats
