#include "formats/dataset/reid_identities.h"

#include <nlohmann/json.hpp>

#include "base/compute/random.h"

namespace throng::formats {

namespace {

constexpr std::uint64_t kReidPairs = std::uint64_t{1} << 44;  // apart from agents' indices

/// Everything in the attributes is constant and rendered: equal ones look alike. Somebody without
/// attributes is like nobody else.
std::string look_key(const Person& person) {
  const auto attributes = person.track->find("attributes");
  if (attributes == person.track->end()) return "track " + std::to_string(person.track_id);
  return attributes->dump();
}

std::string character_name(const Person& person) {
  const auto attributes = person.track->find("attributes");
  if (attributes == person.track->end()) return look_key(person);
  return attributes->value("character", look_key(person));
}

}  // namespace

ReidSide ReidIdentities::side_for(const Person& person) {
  const auto [found, is_new] = sides_.try_emplace(character_name(person), ReidSide::train);
  if (is_new) {
    const std::size_t order = sides_.size() - 1;
    Random drawing(seed_, Stream::participants, kReidPairs + order / 2);
    const bool is_first_for_test = drawing.below(2) == 1;
    if ((order % 2 == 0) == is_first_for_test) found->second = ReidSide::test;
  }
  return found->second;
}

ReidIdentities::Number ReidIdentities::number_of(const Person& person) {
  const int next = static_cast<int>(numbers_.size()) + 1;
  const auto [found, is_new] = numbers_.try_emplace(look_key(person), next);
  return {found->second, is_new};
}

}  // namespace throng::formats
