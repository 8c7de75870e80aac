#include "annotate/people/person_facts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>

#include "annotate/exits/exit_view.h"
#include "annotate/people/color_name.h"
#include "base/error.h"
#include "base/text/words.h"
#include "render/animator.h"
#include "render/people/people_on_stands.h"
#include "skinning/items.h"
#include "skinning/wardrobe/clothes.h"

namespace throng::annotate {

namespace {

constexpr double kStandingMps = 0.2;
constexpr double kRunningMps = 2.07;

std::string_view age_band(double age_years) {
  constexpr double kTeenager = 13;
  constexpr double kAdult = 18;
  constexpr double kSenior = 65;
  if (age_years < kTeenager) return "child";
  if (age_years < kAdult) return "teenager";
  return age_years < kSenior ? "adult" : "senior";
}

bool says_follow(std::string_view state) {
  return lower_case(state).find("follow") != std::string::npos;
}

/// Whether a texture is light and shade only at a part's corners, so that the tint is the color.
bool is_shade(const skinning::Population& population, const skinning::Mesh& mesh,
              const skinning::Part& part) {
  if (part.texture < 0 || population.textures.empty()) return true;
  const auto& texels = population.textures[static_cast<std::size_t>(part.texture)].rgba;
  const int size = population.texture_size;
  const auto place = [size](float share) {
    return std::clamp(static_cast<int>(share * static_cast<float>(size)), 0, size - 1);
  };
  for (std::uint32_t i = 0; i < part.index_count; ++i) {
    const auto& uv = mesh.vertices[mesh.indices[part.first_index + i]].uv;
    const std::size_t at = 4 * static_cast<std::size_t>(place(uv[1]) * size + place(uv[0]));
    if (texels[at] != texels[at + 1] || texels[at] != texels[at + 2]) return false;
  }
  return true;
}

/// Surface of the finest mesh whose color is a tint and that lies from `low_m` to `high_m` above
/// the soles, m².
double tinted_m2(const skinning::Population& population, const skinning::Character& character,
                 skinning::Tint tint, double low_m, double high_m) {
  if (character.levels.empty()) return 0;
  const skinning::Mesh& mesh = character.levels.front();
  // The type is given: an expression would refer to a temporary that is gone.
  const auto corner = [&](std::uint32_t index) -> Eigen::Vector3d {
    return Eigen::Vector3f(mesh.vertices[mesh.indices[index]].position.data()).cast<double>();
  };
  double twice_m2 = 0;
  for (const skinning::Part& part : mesh.parts) {
    if (part.tint != tint || !is_shade(population, mesh, part)) continue;
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
      const std::uint32_t first = part.first_index + i;
      const Eigen::Vector3d a = corner(first);
      if (a.z() < low_m || a.z() >= high_m) continue;
      twice_m2 += (corner(first + 1) - a).cross(corner(first + 2) - a).norm();
    }
  }
  return twice_m2 / 2;
}

/// Less of a color, like a bald man's eyebrows, is none that somebody would name.
constexpr double kMinTintedM2 = 0.01;

/// Whether enough of a character has the color of a tint for it to be named.
bool shows_tint(const skinning::Population& population, const skinning::Character& character,
                skinning::Tint tint, double low_m = -1e9, double high_m = 1e9) {
  return !character.tints[static_cast<std::size_t>(tint)].empty() &&
         tinted_m2(population, character, tint, low_m, high_m) >= kMinTintedM2;
}

std::string encode_hex(const skinning::Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

/// A garment or item with the color that it is rendered in, unless it has several.
nlohmann::json garment_json(std::string_view slot, std::string_view type, bool has_color,
                            const skinning::Rgb& color) {
  nlohmann::json clothing = {{"slot", slot}, {"type", type}};
  if (!has_color) return clothing;
  clothing["colour"] = encode_hex(color);
  clothing["colour_name"] = color_name(color.data());
  return clothing;
}

nlohmann::json clothes_json(const skinning::Population& population,
                            const skinning::Character& character,
                            const skinning::Appearance& appearance) {
  using skinning::ClothesSlot;
  using skinning::Tint;
  const auto color = [&](Tint tint) { return appearance.tint[static_cast<std::size_t>(tint)]; };
  const double middle_m = static_cast<double>(character.stature_m) / 2;
  nlohmann::json clothes = nlohmann::json::array();
  for (const auto& [slot, type] : skinning::clothes_in(character.wears)) {
    const bool is_at_head = slot == ClothesSlot::hat;
    const bool is_dyed_as_shoes = is_at_head || slot == ClothesSlot::shoes;
    const Tint tint = is_dyed_as_shoes             ? Tint::shoes
                      : slot == ClothesSlot::lower ? Tint::bottom
                                                   : Tint::top;
    // Hats are dyed as shoes are: the height tells them apart.
    const bool has_color = is_at_head ? shows_tint(population, character, tint, middle_m)
                           : is_dyed_as_shoes
                               ? shows_tint(population, character, tint, -1e9, middle_m)
                               : shows_tint(population, character, tint);
    clothes.push_back(garment_json(to_string(slot), type, has_color, color(tint)));
  }
  if (character.carries != skinning::Carry::nothing) {
    clothes.push_back(
        garment_json("carried", skinning::kCarryNames[static_cast<std::size_t>(character.carries)],
                     shows_tint(population, character, Tint::item), color(Tint::item)));
  }
  return clothes;
}

nlohmann::json person_attributes(const skinning::Population& population,
                                 const skinning::Character& character,
                                 const skinning::Appearance& appearance) {
  nlohmann::json attributes = {
      {"character", character.name},
      {"sex", character.male ? "male" : "female"},
      {"age_years", static_cast<int>(character.age_years)},
      {"age_band", age_band(character.age_years)},
      {"stature_m", std::round(1000.0 * static_cast<double>(character.stature_m)) / 1000.0},
      {"wears", character.wears},
      {"carries", skinning::kCarryNames[static_cast<std::size_t>(character.carries)]},
      {"clothes", clothes_json(population, character, appearance)}};
  for (const skinning::Tint tint :
       {skinning::Tint::top, skinning::Tint::bottom, skinning::Tint::hair, skinning::Tint::shoes}) {
    if (!shows_tint(population, character, tint)) continue;
    const auto index = static_cast<std::size_t>(tint);
    attributes[std::string(skinning::kTintNames[index]) + "_colour"] =
        encode_hex(appearance.tint[index]);
  }
  return attributes;
}

}  // namespace

std::string_view to_string(Activity activity) {
  constexpr std::array<std::string_view, 10> kNames = {
      "waiting", "walking", "running",    "following", "panicking",
      "lying",   "falling", "getting_up", "sitting",   "squatting"};
  return kNames.at(static_cast<std::size_t>(activity));
}

Activity classify_activity(std::string_view state, std::uint8_t flags, skinning::Actions actions,
                           double speed_mps) {
  using skinning::Action;
  if (actions.has(Action::fall)) return Activity::falling;
  if (actions.has(Action::get_up)) return Activity::getting_up;
  if (actions.has(Action::lie) || (flags & world::kFallen) != 0) return Activity::lying;
  if (actions.has(Action::sit)) return Activity::sitting;
  if (actions.has(Action::squat) || actions.has(Action::cower)) return Activity::squatting;
  if ((flags & world::kPanicked) != 0) return Activity::panicking;
  if (speed_mps < kStandingMps) return Activity::waiting;
  if (says_follow(state)) return Activity::following;
  return speed_mps > kRunningMps ? Activity::running : Activity::walking;
}

PersonFacts::PersonFacts(const world::Trace& trace, const skinning::Population& population,
                         const skinning::Styling& styling)
    : trace_(&trace) {
  for (const std::string& name : trace.header.state_names) {
    behavior_.push_back(nlohmann::json(name).dump());
  }
  for (const std::string& id : trace.header.exit_ids) exit_.push_back(nlohmann::json(id).dump());
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    const skinning::Appearance appearance = skinning::sample_appearance(
        population, trace.header.seed, static_cast<std::uint32_t>(agent), styling,
        render::find_spot(trace.header, agent));
    const std::int32_t group = agent < trace.header.group.size() ? trace.header.group[agent] : -1;
    fixed_.push_back(fmt::format(
        R"(,"group":{},"attributes":{})", group < 0 ? "null" : std::to_string(group),
        person_attributes(population, population.characters[appearance.character], appearance)
            .dump()));
  }
}

std::size_t PersonFacts::step_at(double time_s) const {
  check(!trace_->time_s.empty(), "a trace that is rendered has steps");
  return annotate::step_at(trace_->time_s, time_s);
}

void PersonFacts::append(std::string& text, std::uint32_t agent, double time_s,
                         skinning::Actions actions, double speed_mps) const {
  check(agent < fixed_.size(), "facts are those of the run that is drawn");
  const std::size_t at = trace_->at(step_at(time_s), agent);
  const std::size_t state = trace_->state.empty() ? 0 : trace_->state[at];
  const bool is_named = state < behavior_.size();
  const Activity activity = classify_activity(is_named ? trace_->header.state_names[state] : "",
                                              trace_->flags[at], actions, speed_mps);
  const int exit = trace_->exit_intent.empty() ? -1 : trace_->exit_intent[at];
  const bool has_exit = exit >= 0 && static_cast<std::size_t>(exit) < exit_.size();
  fmt::format_to(std::back_inserter(text), R"(,"state":"{}")", to_string(activity));
  if (is_named) text += R"(,"behaviour":)" + behavior_[state];
  if (has_exit) text += R"(,"exit":)" + exit_[static_cast<std::size_t>(exit)];
}

void PersonFacts::append_track(std::string& text, std::uint32_t agent) const {
  check(agent < fixed_.size(), "facts are those of the run that is drawn");
  text += fixed_[agent];
}

}  // namespace throng::annotate
