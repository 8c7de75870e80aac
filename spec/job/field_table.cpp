#include "spec/job/field_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kMaxCoordinateM = 100'000;

std::string quoted(std::span<const std::string> words) {
  std::vector<std::string> texts;
  for (const std::string& word : words) texts.push_back('"' + word + '"');
  return fmt::format("{}", fmt::join(texts, ", "));
}

Quantity word_quantity(const std::vector<std::string>& words) {
  return {"one of " + quoted(words),
          [words](const json& value) -> std::optional<double> {
            const auto found = std::find(words.begin(), words.end(), value);
            if (found == words.end()) return std::nullopt;
            return static_cast<double>(found - words.begin());
          },
          [words](double index) { return json(words.at(static_cast<std::size_t>(index))); },
          0,
          static_cast<double>(words.size()) - 1,
          false};
}

}  // namespace

Values coordinates(int count, bool is_random) {
  ordered_json items = numbers(-kMaxCoordinateM, kMaxCoordinateM).rules;
  if (is_random) items["x-randomize"] = true;
  return lists(count, count, std::move(items));
}

Values sampled_words(std::span<const std::string> words) {
  return {{{"type", "string"}, {"pattern", fmt::format("^({})$", fmt::join(words, "|"))}},
          "",
          word_quantity({words.begin(), words.end()})};
}

json sampled_json(const Distribution& distribution, const Quantity& quantity) {
  return distribution.to_json(quantity);
}

json sampled_json(const std::optional<Distribution>& distribution, const Quantity& quantity) {
  return distribution ? distribution->to_json(quantity) : json();
}

}  // namespace throng::jobs
