#include "render/props/shape_file.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/json/json_text.h"
#include "render/props/plants.h"

namespace throng::embedded {
extern const std::string_view prop_shapes;  // NOLINT(readability-identifier-naming): a file
}  // namespace throng::embedded

namespace throng::render {

namespace {

using Eigen::Affine3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using nlohmann::json;

struct ShapePaint {
  Vector3d albedo = Vector3d::Zero();
  Finish finish = Finish::matt;
};
using NamedPaints = std::map<std::string, ShapePaint>;

const json& shape_files() {
  static const json files = parse_own_json(embedded::prop_shapes, "the shapes of props");
  return files;
}

Vector3d point(const json& numbers, std::size_t first = 0) {
  const auto at = [&](std::size_t i) { return numbers.at(first + i).get<double>(); };
  return {at(0), at(1), at(2)};
}

Finish finish_named(const std::string& name) {
  static const std::map<std::string, Finish> finishes = {
      {"matt", Finish::matt},   {"glossy", Finish::glossy},
      {"lamp", Finish::lamp},   {"lit_glass", Finish::lit_glass},
      {"water", Finish::water}, {"screen", Finish::screen},
      {"bark", Finish::bark}};
  return finishes.at(name);
}

LeafSprite sprite_named(const std::string& name) {
  static const std::map<std::string, LeafSprite> sprites = {{"broad", LeafSprite::broad},
                                                            {"small", LeafSprite::small},
                                                            {"narrow", LeafSprite::narrow},
                                                            {"needles", LeafSprite::needles}};
  return sprites.at(name);
}

std::size_t choose(const json& choice, const json& options, Random& random) {
  const auto weights = choice.find("weights");
  if (weights == choice.end()) return random.below(static_cast<std::uint32_t>(options.size()));
  check(weights->size() == options.size(), "every option has a weight");
  double sum = 0;
  for (const json& weight : *weights) sum += weight.get<double>();
  double left = random.uniform() * sum;
  for (std::size_t i = 0; i + 1 < options.size(); ++i) {
    left -= weights->at(i).get<double>();
    if (left < 0) return i;
  }
  return options.size() - 1;
}

/// A paint of a file: [red, green, blue], or one of several that varies by a share.
ShapePaint choose_paint(const json& paint, Random& random) {
  if (paint.is_array()) return {point(paint), Finish::matt};
  const json& options = paint.at("one_of");
  const double vary = paint.value("vary", 0.0);
  const Vector3d albedo = point(options.at(choose(paint, options, random)));
  return {random.uniform(1 - vary, 1 + vary) * albedo,
          finish_named(paint.value("finish", std::string("matt")))};
}

NamedPaints choose_paints(const json& file, Random& random) {
  NamedPaints paints;
  for (const json* list : {&shape_files().at("paints"), &file}) {
    const auto found = list->find("paints");
    if (found == list->end()) continue;
    for (const auto& [name, paint] : found->items()) paints[name] = choose_paint(paint, random);
  }
  return paints;
}

void add_lathe(PropBuilder& builder, const json& profile, int sides, const ShapePaint& paint) {
  const auto ring = [](const json& at, double angle) {
    const double radius = at.at(1);
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), at.at(0));
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const json& low = profile.at(i);
    const json& high = profile.at(i + 1);
    const double rise = high.at(0).get<double>() - low.at(0).get<double>();
    const double inward = low.at(1).get<double>() - high.at(1).get<double>();
    for (int side = 0; side < sides; ++side) {
      const double a = 2 * std::numbers::pi * side / sides;
      const double b = 2 * std::numbers::pi * (side + 1) / sides;
      const auto out = [&](double angle) {
        return Vector3d(rise * std::cos(angle), rise * std::sin(angle), inward).normalized();
      };
      builder.quad({ring(low, a), ring(low, b), ring(high, b), ring(high, a)},
                   {out(a), out(b), out(b), out(a)}, paint.albedo, paint.finish);
    }
  }
}

void add_loft(PropBuilder& builder, const json& sections, const ShapePaint& paint) {
  using Section = std::array<Vector3d, 4>;
  const auto section = [](const json& s) {
    const double x = s.at(0);
    const double below = s.at(1);
    const double above = s.at(3);
    return Section{Vector3d(x, -below, s.at(2)), Vector3d(x, below, s.at(2)),
                   Vector3d(x, above, s.at(4)), Vector3d(x, -above, s.at(4))};
  };
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    const Section front = section(sections.at(i));
    const Section back = section(sections.at(i + 1));
    for (std::size_t k = 0; k < front.size(); ++k) {
      const std::size_t next = (k + 1) % front.size();
      builder.quad({front[next], front[k], back[k], back[next]}, paint.albedo, paint.finish);
    }
  }
  builder.quad(section(sections.front()), paint.albedo, paint.finish);
  const Section last = section(sections.back());
  builder.quad({last[3], last[2], last[1], last[0]}, paint.albedo, paint.finish);
}

/// Adds the parts of one file.
class ShapeReader {
 public:
  ShapeReader(const json& file, PropBuilder& builder)
      : builder_(builder), paints_(choose_paints(file, builder.random())) {}

  void add(const json& parts) {
    for (const json& part : parts) add_part(part);
  }

 private:
  void add_part(const json& part) {
    const Affine3d placing = builder_.placing;
    const bool is_near = builder_.is_near;
    builder_.is_near = is_near || part.value("near", false);
    const std::string mirror = part.value("mirror", std::string());
    for (const double x : {1.0, -1.0}) {
      for (const double y : {1.0, -1.0}) {
        if ((x < 0 && mirror.find('x') == std::string::npos) ||
            (y < 0 && mirror.find('y') == std::string::npos)) {
          continue;
        }
        builder_.placing = placing * Eigen::Scaling(x, y, 1.0);
        add_repeated(part, 0);
      }
    }
    builder_.placing = placing;
    builder_.is_near = is_near;
  }

  /// Adds the copies of repeat number `level`, of each those of the next.
  void add_repeated(const json& part, std::size_t level) {
    const json repeats = part.value("repeat", json::array());
    const json list = repeats.is_object() ? json::array({repeats}) : repeats;
    if (level == list.size()) return add_once(part);
    const json& repeat = list.at(level);
    const Affine3d placing = builder_.placing;
    const int count = repeat.at("count");
    for (int i = 0; i < count; ++i) {
      builder_.placing =
          placing *
          Eigen::AngleAxisd(i * kDegree * repeat.value("turn_deg", 0.0), Vector3d::UnitZ()) *
          Eigen::Translation3d(i * point(repeat.value("step", json{0, 0, 0})));
      add_repeated(part, level + 1);
    }
    builder_.placing = placing;
  }

  void add_once(const json& part) {
    Random& random = builder_.random();
    if (part.contains("chance") && random.uniform() >= part.at("chance").get<double>()) return;
    const Affine3d placing = builder_.placing;
    builder_.placing = placing * Eigen::Translation3d(point(part.value("at", json{0, 0, 0}))) *
                       Eigen::AngleAxisd(kDegree * part.value("turn_deg", 0.0), Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(kDegree * part.value("tilt_deg", 0.0), Vector3d::UnitY()) *
                       Eigen::Scaling(part.value("scale", 1.0));
    if (part.contains("shape")) {
      add_shape(part.at("shape").get_ref<const std::string&>(), builder_);
    } else if (part.contains("parts")) {
      add(part.at("parts"));
    } else if (part.contains("one_of")) {
      const json& options = part.at("one_of");
      add(options.at(choose(part, options, random)));
    } else {
      add_surface(part, paint_of(part));
    }
    builder_.placing = placing;
  }

  ShapePaint paint_of(const json& part) {
    const json& names = part.at("paint");
    Random& random = builder_.random();
    ShapePaint paint = paints_.at(
        (names.is_array() ? names.at(choose(part, names, random)) : names).get<std::string>());
    const double vary = part.value("vary", 0.0);
    paint.albedo *= part.value("shade", 1.0) * (vary > 0 ? random.uniform(1 - vary, 1 + vary) : 1);
    if (part.contains("finish")) paint.finish = finish_named(part.at("finish"));
    return paint;
  }

  void add_surface(const json& part, const ShapePaint& paint) {
    const auto& [albedo, finish] = paint;
    const int sides = part.value("sides", 8);
    if (part.contains("box")) {
      const json& box = part.at("box");
      builder_.box(point(box), point(box, 3), albedo, finish);
    } else if (part.contains("block")) {
      const json& b = part.at("block");
      const auto outline = [&](std::size_t i) {
        return Eigen::AlignedBox2d(Vector2d(b.at(i), b.at(i + 1)),
                                   Vector2d(b.at(i + 2), b.at(i + 3)));
      };
      builder_.block(outline(0), b.at(4), outline(5), b.at(9), albedo, finish);
    } else if (part.contains("tube")) {
      const json& t = part.at("tube");
      builder_.tube(point(t), t.at(3), point(t, 4), t.at(7), albedo, finish, sides);
    } else if (part.contains("lathe")) {
      add_lathe(builder_, part.at("lathe"), sides, paint);
    } else if (part.contains("loft")) {
      add_loft(builder_, part.at("loft"), paint);
    } else if (part.contains("quad")) {
      const json& q = part.at("quad");
      const std::array<Vector3d, 4> corners = {point(q.at(0)), point(q.at(1)), point(q.at(2)),
                                               point(q.at(3))};
      builder_.quad(corners, albedo, finish);
      if (part.value("two_sided", false)) {
        builder_.quad({corners[3], corners[2], corners[1], corners[0]}, 0.7 * albedo, finish);
      }
    } else {
      const json& leaves = part.at("foliage");
      add_leaf_body(builder_, {.middle = point(leaves.at("middle")),
                               .radii = point(leaves.at("radii")),
                               .sprite = sprite_named(leaves.at("sprite")),
                               .cards = leaves.at("cards"),
                               .card_m = leaves.at("card_m"),
                               .paint = albedo});
    }
  }

  PropBuilder& builder_;
  NamedPaints paints_;
};

}  // namespace

std::vector<std::string_view> shape_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, file] : shape_files().items()) {
    if (name != "paints") names.emplace_back(name);
  }
  return names;
}

void add_shape(std::string_view name, PropBuilder& builder) {
  try {
    const json& file = shape_files().at(std::string(name));
    ShapeReader(file, builder).add(file.at("parts"));
  } catch (const std::exception& error) {
    check(false, fmt::format("shapes/{}.json is sound: {}", name, error.what()));
  }
}

namespace {

/// The lights of a list of a file, read by `read`.
template <typename Light, typename Read>
std::vector<Light> shape_lights(std::string_view name, const char* list, const Read& read) {
  std::vector<Light> lights;
  const auto file = shape_files().find(std::string(name));
  if (file == shape_files().end()) return lights;
  for (const json& light : file->value(list, json::array())) {
    lights.push_back(read(light));
    lights.back().position = point(light.at("at"));
    lights.back().color = point(light.value("color", json{1, 1, 1})).array();
  }
  return lights;
}

}  // namespace

std::vector<ShapeLamp> shape_lamps(std::string_view name) {
  return shape_lights<ShapeLamp>(name, "lamps", [](const json& light) {
    ShapeLamp lamp;
    lamp.strength = light.at("strength");
    return lamp;
  });
}

std::vector<ShapeBeam> shape_beams(std::string_view name) {
  return shape_lights<ShapeBeam>(name, "beams", [](const json& light) {
    ShapeBeam beam;
    beam.direction = point(light.at("towards")).normalized();
    return beam;
  });
}

}  // namespace throng::render
