#include "crowd/model.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

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

}  // namespace throng::crowd
