#include "crowd/elements/menge_sequences.h"

namespace throng::crowd {

std::shared_ptr<MengeRandom> MengeSequences::next() {
  if (!compatible_) return nullptr;
  return std::make_shared<MengeRandom>(run_seed_ + ++count_);
}

std::shared_ptr<MengeRandom> MengeSequences::next(const Distribution& distribution) {
  if (!compatible_ || distribution.kind == Distribution::Kind::constant) return nullptr;
  return distribution.seed ? std::make_shared<MengeRandom>(*distribution.seed) : next();
}

std::shared_ptr<MengeRandom> MengeSequences::copy(const std::shared_ptr<MengeRandom>& original) {
  return original ? std::make_shared<MengeRandom>(original->seed() + 1) : nullptr;
}

}  // namespace throng::crowd
