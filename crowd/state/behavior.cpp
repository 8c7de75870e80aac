#include "crowd/state/behavior.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/compute/random.h"

namespace throng::crowd {

Draws BehaviorContext::make_draws(std::optional<std::uint64_t> fixed_seed) {
  const std::uint64_t number = next_draws++;
  return Draws(fixed_seed ? *fixed_seed : derive_seed(seed, Stream::crowd_behavior, number));
}

Sampler BehaviorContext::make_sampler(const Distribution& distribution) {
  const Draws draws = make_draws(distribution.seed);
  const std::shared_ptr<MengeRandom> sequence = sequences.next(distribution);
  return {distribution, draws, is_copy ? MengeSequences::copy(sequence) : sequence};
}

Sampler2 BehaviorContext::make_sampler(const Distribution2& distribution) {
  const Draws draws = make_draws();
  if (distribution.is_constant()) return {distribution, draws};
  const std::shared_ptr<MengeRandom> x = sequences.next();
  const std::shared_ptr<MengeRandom> y = sequences.next();
  return {distribution, draws, is_copy ? MengeSequences::copy(x) : x,
          is_copy ? MengeSequences::copy(y) : y};
}

Sampler BehaviorContext::make_set_sampler(int set) {
  const Distribution unit{Distribution::Kind::uniform, 0, 1, {}};
  if (!sequences.compatible()) return {unit, make_draws()};
  return {unit, make_draws(), set_sequences[static_cast<std::size_t>(set)]};
}

std::uint8_t BehaviorContext::require_state(const Element& element, std::string_view attribute,
                                            const std::string& name) const {
  const auto found = std::find(state_names.begin(), state_names.end(), name);
  if (found == state_names.end()) {
    element.fail_attribute(attribute, in_quotes(name),
                           fmt::format("the name of a state: {}", fmt::join(state_names, ", ")));
  }
  return static_cast<std::uint8_t>(found - state_names.begin());
}

const TaskRegistry& task_registry() {
  static const TaskRegistry kRegistry({});
  return kRegistry;
}

}  // namespace throng::crowd
