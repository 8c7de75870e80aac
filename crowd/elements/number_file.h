// Text files of numbers: road maps, vector fields, navigation meshes, formations.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "crowd/elements/attributes.h"
#include "crowd/elements/text_file.h"

namespace throng::crowd {

/// Reads such a file from its beginning to its end. Everything throws InputError (file, line,
/// found, expected) for what is not there or not within its limits.
class NumberFile {
 public:
  /// Throws EnvironmentError when the file cannot be read.
  explicit NumberFile(const TextFile& file);

  /// The next number; `what` names it in errors.
  double number(std::string_view what, double min = -kMaxCoordinate, double max = kMaxCoordinate);
  float real(std::string_view what, double min = -kMaxCoordinate, double max = kMaxCoordinate) {
    return static_cast<float>(number(what, min, max));
  }
  int integer(std::string_view what, int min, int max);
  /// How many records follow, each of `numbers_each` numbers or more: no more than the rest of the
  /// file can hold, so that one may make room for them.
  int count(std::string_view what, int min, int numbers_each);
  /// The rest of the next line that is not empty.
  std::string line(std::string_view what);
  /// Whether only white space is left.
  bool at_end();

  /// About what was read last.
  [[noreturn]] void fail(std::string found, std::string expected) const;

 private:
  void skip_space();
  std::string_view word(std::string_view what);

  std::string name_;  // of the file
  std::string text_;
  std::size_t position_ = 0;
  int line_ = 1;
};

}  // namespace throng::crowd
