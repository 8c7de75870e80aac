// Text files of numbers: road maps, vector fields, navigation meshes, formations.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "crowd/elements/attributes.h"
#include "crowd/elements/text_file.h"

namespace throng::crowd {

/// Reads a text file of numbers sequentially. Functions throw InputError (file, line, found,
/// expected) for missing, malformed and out-of-range values.
class NumberFile {
 public:
  /// Throws EnvironmentError if the file cannot be read.
  explicit NumberFile(const TextFile& file);

  /// Reads the next number; `what` names it in messages.
  double number(std::string_view what, double min = -kMaxCoordinate, double max = kMaxCoordinate);
  float real(std::string_view what, double min = -kMaxCoordinate, double max = kMaxCoordinate) {
    return static_cast<float>(number(what, min, max));
  }
  int integer(std::string_view what, int min, int max);
  /// Reads the number of records that follow, each of at least `numbers_each` numbers. Refuses more
  /// than the rest of the file can hold, so callers may allocate for that number.
  int count(std::string_view what, int min, int numbers_each);
  /// Returns the rest of the next non-empty line.
  std::string line(std::string_view what);
  /// Whether only white space follows.
  bool at_end();

  /// Throws an InputError at the position of the last value read.
  [[noreturn]] void fail(std::string found, std::string expected) const;

 private:
  void skip_space();
  std::string_view word(std::string_view what);

  std::string name_;  // name of the file
  std::string text_;
  std::size_t position_ = 0;
  int line_ = 1;
};

}  // namespace throng::crowd
