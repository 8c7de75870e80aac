// Assignment of a dataset's people to re-identification identities, for training or test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "formats/dataset/dataset.h"

namespace throng::formats {

enum class ReidSide : std::uint8_t { train, test };
inline const char* to_string(ReidSide side) { return side == ReidSide::train ? "train" : "test"; }

/// An identity is an appearance: a character and its colors. People with the same appearance are
/// one identity in all runs, because no image distinguishes them. All identities of a character are
/// on one side, so that the test has no bodies and faces of the training, in whatever clothes.
class ReidIdentities {
 public:
  explicit ReidIdentities(std::uint64_t seed) : seed_(seed) {}

  /// The side of a person's character. Characters are assigned in pairs, in the order of first
  /// calls; the seed determines which one of a pair is for training.
  ReidSide side_for(const Person& person);

  struct Number {
    int number = 0;  ///< from 1, in the order of first calls
    bool is_new = false;
  };
  /// The number of a person's identity.
  Number number_of(const Person& person);

  std::size_t count() const { return numbers_.size(); }

 private:
  std::uint64_t seed_;
  std::map<std::string, ReidSide> sides_;  ///< by character
  std::map<std::string, int> numbers_;     ///< by appearance
};

}  // namespace throng::formats
