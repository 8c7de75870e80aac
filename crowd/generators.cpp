#include "crowd/generators.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "crowd/agents.h"

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

std::unique_ptr<Generator> make_listed(const Element& element, const Attributes&,
                                       GeneratorContext&) {
  std::vector<Eigen::Vector2f> places;
  for (const Element& child : element.children()) {
    if (child.name() != "Agent") child.fail_unknown("<Agent>");
    child.require_no_children();
    const Attributes attributes(child, {number("p_x", "in m"), number("p_y", "in m")});
    places.emplace_back(attributes.real("p_x"), attributes.real("p_y"));
  }
  if (places.empty()) element.fail("no agents", "at least one <Agent>");
  return std::make_unique<Listed>(std::move(places));
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

/// As far as the distribution says, in any direction.
Eigen::Vector2f draw_noise(const Distribution& radius, Random random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double length = radius.sample(random);
  return {static_cast<float>(length * std::cos(angle)),
          static_cast<float>(length * std::sin(angle))};
}

constexpr std::string_view kNoisePrefix = "displace_";

}  // namespace

const GeneratorRegistry& generator_registry() {
  static const GeneratorRegistry kRegistry(
      {{
          {"explicit", "places listed one by one", {}, make_listed},
          {"rect_grid",
           "rows and columns",
           {number("anchor_x", "place of the first agent in m"),
            number("anchor_y", "place of the first agent in m"),
            number("offset_x", "between columns in m"), number("offset_y", "between rows in m"),
            integer("count_x", "columns", 1, kMostAgents),
            integer("count_y", "rows", 1, kMostAgents),
            optional(number("rotation", "about the first agent in degrees", -3600, 3600), "0")},
           make_grid},
      }},
      {optional(distribution(kNoisePrefix, "distance from the exact place in m"))});
  return kRegistry;
}

std::vector<Eigen::Vector2f> generate_places(const Element& element, std::uint64_t seed,
                                             std::size_t first_agent) {
  GeneratorContext context;
  const std::unique_ptr<Generator> generator = generator_registry().make(element, context);
  const std::size_t count = generator->count();
  if (count > kMostAgents - std::min(first_agent, kMostAgents)) {
    element.fail(fmt::format("{} more agents", count),
                 fmt::format("at most {} agents in a scene", kMostAgents));
  }
  const Attributes attributes(element, generator_registry().find(element).attributes);
  const Distribution noise = attributes.has(kNoisePrefix) ? attributes.distribution(kNoisePrefix)
                                                          : Distribution::constant(0);
  std::vector<Eigen::Vector2f> places(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t agent = first_agent + i;
    places[i] = generator->place(
        i, draw_noise(noise, Random(noise.seed.value_or(seed), Stream::crowd_generator, agent)));
  }
  return places;
}

}  // namespace throng::crowd
