#include "crowd/population/generators.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "crowd/agents/agents.h"
#include "crowd/navigation/nav_mesh_file.h"
#include "crowd/navigation/obstacle_sets.h"
#include "crowd/population/scatter.h"

namespace throng::crowd {

namespace {

class Listed : public Generator {
 public:
  explicit Listed(std::vector<Eigen::Vector2f> places) : places_(std::move(places)) {}
  std::size_t count() const override { return places_.size(); }
  Eigen::Vector2f place(std::size_t index, const Eigen::Vector2f& noise) const override {
    return places_[index] + noise;
  }

 private:
  std::vector<Eigen::Vector2f> places_;
};

class RectangularGrid : public Generator {
 public:
  RectangularGrid(const Eigen::Vector2f& anchor, const Eigen::Vector2f& offset, std::size_t columns,
                  std::size_t rows, float angle_rad)
      : anchor_(anchor),
        offset_(offset),
        columns_(columns),
        rows_(rows),
        axis_(std::cos(angle_rad), std::sin(angle_rad)) {}

  std::size_t count() const override { return columns_ * rows_; }

  Eigen::Vector2f place(std::size_t index, const Eigen::Vector2f& noise) const override {
    const std::size_t column = index % columns_;
    const std::size_t row = index / columns_;
    const Eigen::Vector2f cell(static_cast<float>(column), static_cast<float>(row));
    const Eigen::Vector2f local = cell.cwiseProduct(offset_) + noise;
    return anchor_ + local.x() * axis_ + local.y() * Eigen::Vector2f(-axis_.y(), axis_.x());
  }

 private:
  Eigen::Vector2f anchor_;
  Eigen::Vector2f offset_;
  std::size_t columns_;
  std::size_t rows_;
  Eigen::Vector2f axis_;
};

/// Closest packing of discs: rows whose neighbors are shifted by half a disc. Along x every other
/// row has one agent less, and rows are added until there are more agents than the population
/// asked for. Along y rows stand side by side, all with as many agents: one more than it takes.
class HexLattice : public Generator {
 public:
  enum class Alignment { left, center, right };
  struct Shape {
    Eigen::Vector2f anchor = Eigen::Vector2f::Zero();
    float angle_rad = 0;
    float density = 1;  ///< per m^2
    float width_m = 1;  ///< from left to right
    std::size_t population = 1;
    Alignment alignment = Alignment::center;
    bool along_x = true;
  };

  explicit HexLattice(const Shape& shape)
      : shape_(shape),
        axis_(std::cos(shape.angle_rad), std::sin(shape.angle_rad)),
        radius_(1 / std::sqrt(2 * shape.density * std::numbers::sqrt3_v<float>)),
        row_distance_(radius_ * std::numbers::sqrt3_v<float>) {
    const float step = shape.along_x ? 2 * radius_ : row_distance_;
    across_ = std::max<std::size_t>(1, static_cast<std::size_t>(shape.width_m / step));
    left_ = left_end(static_cast<float>(across_ - 1) * step);
  }

  std::size_t count() const override {
    if (!shape_.along_x) return across_ * column();
    const std::size_t pairs = shape_.population / two_rows();
    const std::size_t rest = shape_.population % two_rows();
    return pairs * two_rows() + (rest < across_ ? across_ : two_rows());
  }

  Eigen::Vector2f place(std::size_t index, const Eigen::Vector2f& noise) const override {
    const Eigen::Vector2f local = (shape_.along_x ? in_rows(index) : in_columns(index)) + noise;
    return shape_.anchor + local.x() * axis_ + local.y() * Eigen::Vector2f(-axis_.y(), axis_.x());
  }

 private:
  std::size_t two_rows() const { return 2 * across_ - 1; }
  std::size_t column() const { return shape_.population / across_ + 1; }

  float left_end(float extent) const {
    switch (shape_.alignment) {
      case Alignment::left:
        return 0;
      case Alignment::right:
        return -extent;
      case Alignment::center:
        break;
    }
    return -0.5F * extent;
  }

  Eigen::Vector2f in_rows(std::size_t index) const {
    const bool shifted = index % two_rows() >= across_;
    const std::size_t row = 2 * (index / two_rows()) + (shifted ? 1 : 0);
    const std::size_t place = index % two_rows() - (shifted ? across_ : 0);
    return {left_ + (shifted ? radius_ : 0) + 2 * radius_ * static_cast<float>(place),
            row_distance_ * static_cast<float>(row)};
  }

  Eigen::Vector2f in_columns(std::size_t index) const {
    const std::size_t number = index / column();
    return {left_ + row_distance_ * static_cast<float>(number),
            (number % 2 == 0 ? 0 : radius_) + 2 * radius_ * static_cast<float>(index % column())};
  }

  Shape shape_;
  Eigen::Vector2f axis_;
  float radius_;  // of the discs, m
  float row_distance_;
  float left_ = 0;          // x of the first agent
  std::size_t across_ = 1;  // agents in the first row, or columns
};

constexpr int kAnyGroup = -1;

/// Throws for a place off the mesh, or off the polygons of the group.
void require_on_mesh(const Element& element, const NavMeshFile& file, int group,
                     const Eigen::Vector2f& place) {
  const int polygon = file.mesh.find(place);
  if (polygon >= 0 && (group == kAnyGroup || file.mesh[polygon].group == group)) return;
  element.fail(fmt::format("({}, {}), which is not on the mesh", place.x(), place.y()),
               group == kAnyGroup
                   ? "a position on the mesh"
                   : fmt::format("a position on the mesh's group {}",
                                 in_quotes(file.groups[static_cast<std::size_t>(group)])));
}

std::unique_ptr<Generator> make_listed_on(const Element& element, const NavMeshFile* mesh,
                                          int group) {
  std::vector<Eigen::Vector2f> places;
  for (const Element& child : element.children()) {
    if (child.name() != "Agent") child.fail_unknown("<Agent>");
    child.require_no_children();
    const Attributes attributes(child, {number("p_x", "in m"), number("p_y", "in m")});
    places.emplace_back(attributes.real("p_x"), attributes.real("p_y"));
    if (mesh != nullptr) require_on_mesh(child, *mesh, group, places.back());
  }
  if (places.empty()) element.fail("no agents", "at least one <Agent>");
  return std::make_unique<Listed>(std::move(places));
}

std::unique_ptr<Generator> make_listed(const Element& element, const Attributes&,
                                       GeneratorContext&) {
  return make_listed_on(element, nullptr, kAnyGroup);
}

std::unique_ptr<Generator> make_listed_on_mesh(const Element& element, const Attributes& attributes,
                                               GeneratorContext& context) {
  const auto mesh =
      shared_nav_mesh(element.text_file(attributes.text("file_name")), *context.crowd.parts);
  if (!attributes.has("group_name")) return make_listed_on(element, mesh.get(), kAnyGroup);
  const std::string& name = attributes.text("group_name");
  const auto found = std::find(mesh->groups.begin(), mesh->groups.end(), name);
  if (found == mesh->groups.end()) {
    element.fail_attribute("group_name", in_quotes(name),
                           fmt::format("a group of the mesh: {}", fmt::join(mesh->groups, ", ")));
  }
  return make_listed_on(element, mesh.get(), static_cast<int>(found - mesh->groups.begin()));
}

std::unique_ptr<Generator> make_grid(const Element& element, const Attributes& attributes,
                                     GeneratorContext&) {
  element.require_no_children();
  return std::make_unique<RectangularGrid>(
      Eigen::Vector2f(attributes.real("anchor_x"), attributes.real("anchor_y")),
      Eigen::Vector2f(attributes.real("offset_x"), attributes.real("offset_y")),
      static_cast<std::size_t>(attributes.integer("count_x")),
      static_cast<std::size_t>(attributes.integer("count_y")),
      attributes.real("rotation") * kRadiansPerDegree);
}

std::unique_ptr<Generator> make_hex_lattice(const Element& element, const Attributes& attributes,
                                            GeneratorContext&) {
  element.require_no_children();
  using Alignment = HexLattice::Alignment;
  HexLattice::Shape shape;
  shape.anchor = {attributes.real("anchor_x"), attributes.real("anchor_y")};
  shape.angle_rad = attributes.real("rotation") * kRadiansPerDegree;
  shape.density = attributes.real("density");
  shape.width_m = attributes.real("width");
  shape.population = static_cast<std::size_t>(attributes.integer("population"));
  const std::string& alignment = attributes.text("alignment");
  shape.alignment = alignment == "left"    ? Alignment::left
                    : alignment == "right" ? Alignment::right
                                           : Alignment::center;
  shape.along_x = attributes.text("row_direction") == "x";
  return std::make_unique<HexLattice>(shape);
}

std::unique_ptr<Generator> make_scattered(const Element& element, const Attributes& attributes,
                                          GeneratorContext& context) {
  ScatterSpec spec;
  spec.area = read_polygon(element);
  spec.count = static_cast<std::size_t>(attributes.integer("count"));
  spec.apart_m = attributes.real("apart");
  spec.clearance_m = attributes.real("clearance");
  if (attributes.has("obstacleSet")) {
    spec.obstacle_mask = static_cast<std::uint32_t>(attributes.integer("obstacleSet"));
  }
  const Agents& agents = context.crowd.agents;
  std::vector<Eigen::Vector2f> taken;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (agents.present[i] != 0) taken.push_back(agents.position[i]);
  }
  std::vector<Eigen::Vector2f> places;
  // In a nook the first of a few people may stand in the way of the others.
  constexpr std::uint64_t kMaxDraws = 20;
  for (std::uint64_t draw = 0; draw < kMaxDraws && places.size() < spec.count; ++draw) {
    constexpr std::uint64_t kArea = std::uint64_t{1} << 63;  // apart from the agents' noise
    constexpr unsigned kDrawBit = 48;
    const std::uint64_t stream = kArea | draw << kDrawBit | context.first_agent;
    places = scatter(spec, context.crowd.obstacles, taken,
                     Random(context.seed, Stream::crowd_generator, stream));
  }
  if (places.size() < spec.count) {
    element.fail_attribute(
        "count", std::to_string(spec.count),
        fmt::format("a number for which there is room: {} people found some that "
                    "is {} m from others and {} m from walls",
                    places.size(), spec.apart_m, spec.clearance_m));
  }
  return std::make_unique<Listed>(std::move(places));
}

constexpr std::string_view kNoisePrefix = "displace_";

/// How far agents are from their exact places: as far as a distribution says, in any direction.
class Noise {
 public:
  Noise(const Attributes& attributes, std::uint64_t seed, MengeSequences& sequences) : seed_(seed) {
    if (!attributes.has(kNoisePrefix)) return;
    radius_ = attributes.distribution(kNoisePrefix);
    radii_ = sequences.next(radius_);
    directions_ = sequences.next();
  }

  Eigen::Vector2f draw(std::size_t agent) const {
    if (directions_) {
      const double length = radii_ ? radius_.sample(*radii_) : radius_.first;
      return polar(length, 2 * std::numbers::pi * directions_->uniform());
    }
    Random random(radius_.seed.value_or(seed_), Stream::crowd_generator, agent);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    return polar(radius_.sample(random), angle);
  }

 private:
  static Eigen::Vector2f polar(double length, double angle) {
    return {static_cast<float>(length * std::cos(angle)),
            static_cast<float>(length * std::sin(angle))};
  }

  std::uint64_t seed_;
  Distribution radius_;
  std::shared_ptr<MengeRandom> radii_;
  std::shared_ptr<MengeRandom> directions_;
};

}  // namespace

const GeneratorRegistry& generator_registry() {
  static const GeneratorRegistry kRegistry(
      {{
          {"explicit", "positions listed one by one", {}, make_listed},
          {"rect_grid",
           "rows and columns",
           {number("anchor_x", "position of the first agent in m"),
            number("anchor_y", "position of the first agent in m"),
            number("offset_x", "between columns in m"), number("offset_y", "between rows in m"),
            integer("count_x", "columns", 1, kMaxAgents), integer("count_y", "rows", 1, kMaxAgents),
            optional(number("rotation", "about the first agent in degrees", -3600, 3600), "0")},
           make_grid},
          {"hex_lattice",
           "closest packing of discs, at least as many as asked for",
           {number("anchor_x", "where the first row begins, in m"),
            number("anchor_y", "where the first row begins, in m"),
            word("alignment", {"center", "left", "right"}, "what of the rows is at the anchor"),
            word("row_direction", {"x", "y"}, "along which rows run before they are turned"),
            number("density", "agents per m^2", 1e-6, 1000),
            number("width", "from left to right in m", 1e-3, kMaxCoordinate),
            integer("population", "lowest number of agents; rows are completed", 1, kMaxAgents),
            optional(number("rotation", "about the anchor in degrees", -3600, 3600), "0")},
           make_hex_lattice},
          {"nav_mesh_explicit",
           "positions listed one by one, each on a navigation mesh",
           {text("file_name", "a .nav file"),
            optional(text("group_name", "of polygons, on which they have to be"))},
           make_listed_on_mesh},
          {"scatter",
           "at random in the free part of a polygon of <Vertex> children, elsewhere for every seed",
           {integer("count", "agents", 1, kMaxAgents),
            optional(number("apart", "least distance of two agents in m", 0.01, 1000), "0.5"),
            optional(number("clearance", "least distance from walls in m", 0, 1000), "0.3"),
            optional(integer("obstacleSet", "bits of the obstacle classes to keep out of; all", 0,
                             std::numeric_limits<std::uint32_t>::max()))},
           make_scattered},
      }},
      {optional(distribution(kNoisePrefix, "distance from the exact position in m"))});
  return kRegistry;
}

std::vector<Eigen::Vector2f> generate_positions(const Element& element, GeneratorContext context,
                                                MengeSequences& sequences) {
  const GeneratorRegistry::Entry& entry = generator_registry().find(element);
  const Attributes attributes(element, entry.attributes);
  const std::unique_ptr<Generator> generator = entry.make(element, attributes, context);
  const std::size_t count = generator->count();
  if (count > kMaxAgents - std::min(context.first_agent, kMaxAgents)) {
    element.fail(fmt::format("{} more agents", count),
                 fmt::format("at most {} agents in a scene", kMaxAgents));
  }
  const Noise noise(attributes, context.seed, sequences);
  std::vector<Eigen::Vector2f> places(count);
  for (std::size_t i = 0; i < count; ++i) {
    places[i] = generator->place(i, noise.draw(context.first_agent + i));
  }
  return places;
}

}  // namespace throng::crowd
