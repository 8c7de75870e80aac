#include "crowd/state/model.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "base/compute/random.h"
#include "base/error.h"
#include "base/text/csv.h"
#include "crowd/elements/element.h"
#include "crowd/elements/suggest.h"

namespace throng::crowd {

const std::vector<ModelEntry>& models() {
  static const std::vector<ModelEntry> kModels = {
      orca_model(),      ttc_model(),        weidmann_model(), pedvo_model(), helbing_model(),
      johansson_model(), karamouzas_model(), zanlungo_model(), gcf_model(),   dummy_model(),
  };
  return kModels;
}

const ModelEntry& find_model(std::string_view name) {
  std::vector<std::string_view> known;
  for (const ModelEntry& model : models()) {
    if (model.name == name || (!model.alias.empty() && model.alias == name)) return model;
    known.push_back(model.name);
  }
  throw InputError(Problem{"", "pedestrian model", in_quotes(name) + did_you_mean(name, known),
                           fmt::format("one of {}", fmt::join(known, ", "))});
}

namespace {

void set_constant(const ModelEntry& model, std::string_view name, float value,
                  std::vector<float>& values) {
  const auto found =
      std::find_if(model.constants.begin(), model.constants.end(),
                   [&](const ModelParameter& constant) { return constant.name == name; });
  check(found != model.constants.end(), "tables of a model name its constants");
  values[static_cast<std::size_t>(found - model.constants.begin())] = value;
}

void draw_constants(const ModelEntry& model, std::uint64_t seed, std::vector<float>& values) {
  std::vector<std::string_view> lines;
  for (std::string_view rest = model.posterior; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (end > 0) lines.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  check(lines.size() > 1, "a posterior has a line of names and at least one draw");
  constexpr std::uint64_t kPosteriorPart = 0x706f73746572;  // apart from other draws of the stream
  Random random(derive_seed(seed, Stream::crowd_model, kPosteriorPart), Stream::crowd_model);
  const auto draw = random.below(static_cast<std::uint32_t>(lines.size() - 1));
  const std::vector<std::string> names = csv_cells(lines.front());
  const std::vector<std::string> cells = csv_cells(lines[draw + 1]);
  check(names.size() == cells.size(), "all lines of a posterior have the same columns");
  for (std::size_t i = 0; i < names.size(); ++i) {
    set_constant(model, names[i], std::stof(cells[i]), values);
  }
}

/// Throws InputError that says which models have values of this choice.
[[noreturn]] void reject_choice(const ModelEntry& model, ConstantsChoice choice) {
  const std::string_view word = kConstantsWords.at(static_cast<std::size_t>(choice));
  throw InputError(Problem{"", "constants", fmt::format("{} of the model {}", word, model.name),
                           "best: only ttc has others"});
}

}  // namespace

std::vector<float> chosen_constants(const ModelEntry& model, ConstantsChoice choice,
                                    std::uint64_t seed) {
  std::vector<float> values;
  for (const ModelParameter& constant : model.constants) values.push_back(constant.initial);
  if (choice == ConstantsChoice::posterior) {
    if (model.posterior.empty()) reject_choice(model, choice);
    draw_constants(model, seed, values);
  }
  if (choice == ConstantsChoice::conservative) {
    if (model.conservative.empty()) reject_choice(model, choice);
    for (const auto& [name, value] : model.conservative) set_constant(model, name, value, values);
  }
  return values;
}

}  // namespace throng::crowd
