// Classes per pixel against the masks of people and drones, and against the image of instances.
#include <fmt/format.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "checks/ground_truth_checks.h"
#include "formats/dataset/instances.h"
#include "formats/dataset/mask.h"
#include "world/semantic_class.h"

namespace throng::checks {

using world::SemanticClass;
using world::SemanticGroup;

namespace {

/// The group of a value in the image of instances.
SemanticGroup group_of_instance(std::uint32_t id) {
  if (id == 0) return SemanticGroup::nothing;
  if (id < formats::kFirstUmbrella) return SemanticGroup::person;
  if (id < formats::kFirstBuilding) return SemanticGroup::umbrella;
  if (id < formats::kFirstProp) return SemanticGroup::building;
  if (id < formats::kFirstDrone) return SemanticGroup::prop;
  return id < formats::kGround ? SemanticGroup::drone : SemanticGroup::ground;
}

/// Pixels of another kind than their instance, and pixels of props with several classes.
struct Disagreements {
  std::size_t kind = 0;
  std::size_t prop = 0;
};

Disagreements disagreements(const std::vector<std::uint16_t>& classes,
                            const std::vector<std::uint32_t>& ids) {
  Disagreements found;
  std::unordered_map<std::uint32_t, std::uint16_t> props;  // class by id
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (classes[i] >= world::kSemanticClasses) continue;
    const SemanticGroup group = group_of_instance(ids[i]);
    const bool is_led = group == SemanticGroup::umbrella &&
                        classes[i] == static_cast<std::uint16_t>(SemanticClass::bicycle);
    found.kind += world::semantic_classes()[classes[i]].group == group || is_led ? 0 : 1;
    if (group == SemanticGroup::prop) {
      found.prop += props.try_emplace(ids[i], classes[i]).first->second == classes[i] ? 0 : 1;
    }
  }
  return found;
}

/// Pixels that the masks of people, or of drones, cover: 1, else 0.
std::vector<std::uint8_t> covered_by(const std::vector<formats::Person>& objects,
                                     const formats::Image& image) {
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> covered(width * static_cast<std::size_t>(image.height), 0);
  for (const formats::Person& object : objects) {
    const formats::Bitmap mask =
        formats::decode_bitmap(formats::decode_runs(object.mask, covered.size()), image.height);
    for (int y = mask.y; y < mask.y + mask.height; ++y) {
      for (int x = mask.x; x < mask.x + mask.width; ++x) {
        if (mask.at(x, y))
          covered[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = 1;
      }
    }
  }
  return covered;
}

}  // namespace

void check_semantic(const formats::DatasetInfo& info, const formats::Image& image,
                    const Pixels& pixels, Findings& findings) {
  const std::vector<std::uint16_t>& classes = pixels.semantic;
  if (classes.empty()) return;
  const auto fault = [&](std::size_t wrong, const char* what) {
    if (wrong == 0) return;
    findings.add("semantic", raster_name("semantic", image), fmt::format("image {}", image.id),
                 fmt::format("{} pixels {}", wrong, what));
  };
  std::size_t unknown = 0;
  for (const std::uint16_t value : classes) {
    unknown += value >= world::kSemanticClasses ? 1 : 0;
  }
  fault(unknown, "have a value that is no class");
  const auto compare = [&](const std::vector<formats::Person>& objects, SemanticClass expected,
                           const char* what) {
    const std::vector<std::uint8_t> covered = covered_by(objects, image);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < classes.size(); ++i) {
      wrong += (classes[i] == static_cast<std::uint16_t>(expected)) == (covered[i] == 1) ? 0 : 1;
    }
    fault(wrong, what);
  };
  compare(image.people, SemanticClass::person, "are of a person, but in no mask, or the reverse");
  // Drones show whether or not the job has several; vehicles have labels only if it asks for them.
  std::map<SemanticClass, std::vector<formats::Person>> objects = {{SemanticClass::drone, {}}};
  for (const annotate::ObjectCategory& known : info.object_categories) objects[known.surface];
  for (const formats::Person& object : image.objects)
    objects[info.surface_material(object)].push_back(object);
  for (const auto& [surface, shown] : objects) {
    compare(shown, surface, "are of a drone or vehicle, but in no mask, or the reverse");
  }
  const Disagreements found = disagreements(classes, pixels.ids);
  fault(found.kind, "have a class of another kind than the instance that they show");
  fault(found.prop, "are of a prop that shows another class elsewhere in the image");
}

}  // namespace throng::checks
