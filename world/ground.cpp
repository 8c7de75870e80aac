#include "world/ground.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/geometry/polygon.h"
#include "world/json_reader.h"

namespace throng::world {

namespace {

constexpr double kMaxCoordinateM = 100'000;

template <std::size_t N>
std::string read_word(const JsonValue& value, const std::array<std::string_view, N>& words) {
  std::string word = value.text();
  if (std::find(words.begin(), words.end(), word) == words.end()) {
    value.reject(fmt::format("one of: {}", fmt::join(words, ", ")));
  }
  return word;
}

}  // namespace

std::string read_ground_material(const JsonValue& value) {
  constexpr std::array<std::string_view, 5> kMaterials = {"pavers", "asphalt", "grass", "concrete",
                                                          "dirt"};
  return read_word(value, kMaterials);
}

std::vector<GroundArea> read_ground_areas(const JsonValue& list) {
  std::vector<GroundArea> areas;
  for (const JsonValue& item : list.items()) {
    item.fields({"corners", "material"}, {"kerb"});
    GroundArea area;
    for (const JsonValue& corner : item["corners"].items(3)) {
      area.corners.push_back(corner.vector2(kMaxCoordinateM));
    }
    if (area.corners.size() >= 3) {
      if (!geometry::is_simple(area.corners)) {
        item["corners"].reject("edges that touch each other",
                               "a polygon whose corners all differ and whose edges do not cross");
      } else if (geometry::signed_area(area.corners) < 0) {
        std::reverse(area.corners.begin(), area.corners.end());
      }
    }
    area.material = read_ground_material(item["material"]);
    if (item["kerb"].exists()) area.kerb = item["kerb"].integer(0, 1) == 1;
    areas.push_back(std::move(area));
  }
  return areas;
}

std::vector<Marking> read_markings(const JsonValue& list) {
  constexpr std::array<std::string_view, 3> kKinds = {"line", "dashes", "crossing"};
  constexpr double kMinLengthM = 0.05;
  std::vector<Marking> markings;
  for (const JsonValue& item : list.items()) {
    item.fields({"kind", "from", "to"}, {"width_m"});
    Marking marking;
    marking.kind = read_word(item["kind"], kKinds);
    marking.from = item["from"].vector2(kMaxCoordinateM);
    marking.to = item["to"].vector2(kMaxCoordinateM);
    marking.width_m = marking.kind == "crossing" ? 4 : 0.12;
    if (item["width_m"].exists()) marking.width_m = item["width_m"].number(kMinLengthM, 20);
    if (item["to"].exists() && item["from"].exists() &&
        (marking.to - marking.from).norm() < kMinLengthM) {
      item["to"].reject(fmt::format("an end at least {} m from \"from\"", kMinLengthM));
    }
    markings.push_back(std::move(marking));
  }
  return markings;
}

}  // namespace throng::world
