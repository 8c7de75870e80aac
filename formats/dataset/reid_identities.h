// People of a dataset as identities of re-identification, for training or for the test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "formats/dataset/dataset.h"

namespace throng::formats {

enum class ReidSide : std::uint8_t { train, test };
inline const char* to_string(ReidSide side) { return side == ReidSide::train ? "train" : "test"; }

/// An identity is a look: the character and the colors that it is rendered in. Two people who look
/// exactly alike, as characters without colors of their own do, are one identity in all runs, since
/// no image tells them apart. Identities of one character are all on one side: a body and a face
/// that training has seen do not come in the test, in whatever clothes.
class ReidIdentities {
 public:
  explicit ReidIdentities(std::uint64_t seed) : seed_(seed) {}

  /// The side of somebody's character. Characters are dealt out in pairs, in the order in which
  /// they are first asked for; the seed says who of a pair is for training.
  ReidSide side_for(const Person& person);

  struct Number {
    int number = 0;  ///< from 1, in the order of first calls
    bool is_new = false;
  };
  /// The number of somebody's identity.
  Number number_of(const Person& person);

  std::size_t count() const { return numbers_.size(); }

 private:
  std::uint64_t seed_;
  std::map<std::string, ReidSide> sides_;  ///< by character
  std::map<std::string, int> numbers_;     ///< by look
};

}  // namespace throng::formats
