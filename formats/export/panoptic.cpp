// COCO panoptic: the dataset's images of instances, and a list of their segments. With semantic
// classes the ground is a segment for each of its classes, and props have theirs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "annotate/rasters/png.h"
#include "base/error.h"
#include "base/files/untrusted_folders.h"
#include "base/graphics/images/raster.h"
#include "formats/dataset/instances.h"
#include "formats/dataset/raster_files.h"
#include "formats/export/makers.h"
#include "spec/annotate/license.h"
#include "world/semantic_class.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

struct Segment {
  std::uint64_t area = 0;
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  world::SemanticClass surface{};  ///< of one of its pixels

  void add(int x, int y) {
    if (area++ == 0) *this = {1, x, y, x + 1, y + 1};
    left = std::min(left, x);
    right = std::max(right, x + 1);
    bottom = y + 1;
  }
};

/// The supercategory of a class that segments have; null for the others. A building is one segment,
/// whatever surfaces of it show.
const char* supercategory(const world::SemanticClassInfo& known) {
  using world::SemanticClass;
  using world::SemanticGroup;
  switch (known.group) {
    case SemanticGroup::ground:
    case SemanticGroup::prop:
      return "place";
    case SemanticGroup::building:
      return known.value == SemanticClass::roof || known.value == SemanticClass::door ? nullptr
                                                                                      : "place";
    case SemanticGroup::umbrella:
      return "accessory";
    case SemanticGroup::drone:
      return "vehicle";
    case SemanticGroup::nothing:
    case SemanticGroup::person:
      break;
  }
  return nullptr;
}

/// The class of a segment that is no person.
world::SemanticClass segment_class(const Segment& segment) {
  using world::SemanticClass;
  const SemanticClass shown = segment.surface;
  const bool is_part = shown == SemanticClass::roof || shown == SemanticClass::door;
  return is_part ? SemanticClass::building : shown;
}

/// Gives each class of ground an id of its own.
void divide_ground(const std::vector<world::SemanticClass>& surfaces,
                   std::vector<std::uint32_t>& ids) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == kGround) ids[i] += static_cast<std::uint32_t>(surfaces[i]);
  }
}

std::string instances_png(const Image& image, const std::vector<std::uint32_t>& ids) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * ids.size());
  for (const std::uint32_t id : ids) {
    for (const unsigned shift : {0U, 8U, 16U})
      rgb.push_back(static_cast<std::uint8_t>(id >> shift));
  }
  return annotate::png_bytes({image.width, image.height, 3}, std::span<const std::uint8_t>(rgb));
}

class PanopticExporter : public Exporter {
 public:
  PanopticExporter(const DatasetInfo& info, Output output)
      : info_(info),
        output_(std::move(output)),
        has_classes_(info.has(annotate::GroundTruth::semantic)) {
    for (const Split split : info.splits()) {
      for (OutputStream* stream :
           {&stream_of(split, images_, ".images"), &stream_of(split, segments_, ".annotations")}) {
        stream->write("");
      }
    }
  }

  void add(const Image& image) override {
    const std::string_view split = to_string(image.split);
    const std::string name = image.stem() + ".jpg";
    const fs::path instances = raster_path(info_.root, "instances", image.file);
    output_.link(fs::path(split) / name, info_.root / image.file);
    std::vector<std::uint32_t> ids = read_instances(instances, image.width, image.height);
    const std::string png = fmt::format("panoptic_{}/{}.png", split, image.stem());
    std::vector<world::SemanticClass> surfaces;
    if (has_classes_) {
      surfaces =
          read_classes(raster_path(info_.root, "semantic", image.file), image.width, image.height);
      divide_ground(surfaces, ids);
      output_.write(png, instances_png(image, ids));
    } else {
      output_.link(png, instances);
    }
    const json record = {
        {"id", image.id}, {"file_name", name}, {"width", image.width}, {"height", image.height}};
    append(images_.at(image.split), record);
    const json annotation = {{"image_id", image.id},
                             {"file_name", image.stem() + ".png"},
                             {"segments_info", segments_of(image, ids, surfaces)}};
    append(segments_.at(image.split), annotation);
  }

  void finish() override {
    output_.write("panoptic_coco_categories.json", categories().dump());
    for (const Split split : info_.splits()) {
      OutputStream file = output_.open(annotations_path(split));
      const json head = {{"description", info_.name}, {"version", "1"}};
      file.write(fmt::format("{{\"info\":{},\n\"licenses\":{},\n\"categories\":{},\n\"images\":[",
                             head.dump(), annotate::kCocoLicenses, categories().dump()));
      take_over(file, split, images_.at(split), ".images");
      file.write("\n],\n\"annotations\":[");
      take_over(file, split, segments_.at(split), ".annotations");
      file.write("\n]}\n");
      file.close();
    }
  }

 private:
  /// Records of one kind, aside until the file is put together.
  struct Aside {
    OutputStream stream;
    bool is_empty = true;
    void write(std::string_view text) { stream.write(text); }
  };

  static std::string annotations_path(Split split) {
    return fmt::format("annotations/panoptic_{}.json", to_string(split));
  }

  OutputStream& stream_of(Split split, std::map<Split, Aside>& asides, const char* suffix) {
    return asides
        .try_emplace(split,
                     Aside{OutputStream(output_.folder() / (annotations_path(split) + suffix))})
        .first->second.stream;
  }

  static void append(Aside& aside, const json& record) {
    aside.write((aside.is_empty ? "\n" : ",\n") + record.dump());
    aside.is_empty = false;
  }

  void take_over(OutputStream& file, Split split, Aside& aside, const char* suffix) {
    aside.stream.close();
    const fs::path path = output_.folder() / (annotations_path(split) + suffix);
    std::ifstream from = open_stream(path);
    for (std::string line; std::getline(from, line);) {
      if (!line.empty()) file.write("\n" + line);
    }
    from.close();
    fs::remove(path);
  }

  /// Each has a color of its own, which COCO's converters and viewers require.
  json categories() const {
    using world::SemanticClass;
    using world::SemanticGroup;
    json list = json::array();
    const auto add = [&](std::string_view name, std::string_view group, bool is_thing,
                         std::array<int, 3> color) {
      list.push_back({{"id", list.size() + 1},
                      {"name", name},
                      {"supercategory", group},
                      {"isthing", is_thing ? 1 : 0},
                      {"color", color}});
    };
    const auto color_of = [](SemanticClass value, int more_blue = 0) -> std::array<int, 3> {
      const auto& [red, green, blue] = world::semantic_class_info(value).color;
      return {red, green, blue + more_blue};
    };
    constexpr int kStep = 20;  // from one class of people to the next
    for (const std::string& name : info_.categories) {
      add(name, "person", true,
          color_of(SemanticClass::person, kStep * static_cast<int>(list.size())));
    }
    if (has_classes_) {
      for (const world::SemanticClassInfo& known : world::semantic_classes()) {
        const char* group = supercategory(known);
        if (group == nullptr) continue;
        add(known.name, group, known.group != SemanticGroup::ground, color_of(known.value));
        list.back()["id"] = category_of(known.value);
      }
      return list;
    }
    for (const auto& [name, group, is_thing, surface] :
         {std::tuple{"building", "place", true, SemanticClass::building},
          {"prop", "place", true, SemanticClass::object},
          {"ground", "place", false, SemanticClass::pavement},
          {"accessory", "accessory", true, SemanticClass::umbrella},
          {"drone", "vehicle", true, SemanticClass::drone}}) {
      add(name, group, is_thing, color_of(surface));
    }
    return list;
  }

  /// The category of a class in a dataset with semantic classes: they follow those of people.
  std::size_t category_of(world::SemanticClass value) const {
    return info_.categories.size() + static_cast<std::size_t>(value);
  }

  /// Which of the categories after people's, from 0.
  static std::size_t place_of(std::uint32_t number) {
    if (number < kFirstBuilding) return 3;
    if (number == kGround) return 2;
    if (number >= kFirstDrone) return 4;
    return number >= kFirstProp ? 1 : 0;
  }

  /// `surfaces` are the pixels' classes, if the dataset has them.
  json segments_of(const Image& image, const std::vector<std::uint32_t>& ids,
                   const std::vector<world::SemanticClass>& surfaces) const {
    std::map<std::uint32_t, Segment> segments;
    std::size_t pixel = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x, ++pixel) {
        if (ids[pixel] == 0) continue;
        Segment& segment = segments[ids[pixel]];
        segment.add(x, y);
        if (has_classes_) segment.surface = surfaces[pixel];
      }
    }
    std::map<std::uint32_t, const Person*> people;
    for (const Person& person : image.people) {
      people[static_cast<std::uint32_t>(person.number_in_run())] = &person;
    }
    json list = json::array();
    const std::size_t classes = info_.categories.size();
    for (const auto& [number, segment] : segments) {
      std::size_t category = 0;
      bool is_crowd = false;
      if (number >= kFirstUmbrella) {
        category =
            has_classes_ ? category_of(segment_class(segment)) - 1 : classes + place_of(number);
      } else if (const auto person = people.find(number); person != people.end()) {
        category = person->second->category;
        is_crowd = person->second->is_ignored;
      }
      list.push_back({{"id", number},
                      {"category_id", category + 1},
                      {"area", segment.area},
                      {"bbox",
                       {segment.left, segment.top, segment.right - segment.left,
                        segment.bottom - segment.top}},
                      {"iscrowd", is_crowd ? 1 : 0}});
    }
    return list;
  }

  const DatasetInfo& info_;
  Output output_;
  bool has_classes_;
  std::map<Split, Aside> images_;
  std::map<Split, Aside> segments_;
};

}  // namespace

ExporterPointer make_coco_panoptic(const DatasetInfo& info, Output output) {
  return std::make_unique<PanopticExporter>(info, std::move(output));
}

}  // namespace throng::formats
