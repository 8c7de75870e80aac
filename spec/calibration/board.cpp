#include "spec/calibration/board.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"

namespace throng::calibrate {

std::string_view to_string(Board::Kind kind) {
  return kBoardKinds.at(static_cast<std::size_t>(kind));
}

Board::Kind board_kind_named(std::string_view name, const std::string& source) {
  const auto* found = std::find(kBoardKinds.begin(), kBoardKinds.end(), name);
  if (found == kBoardKinds.end()) {
    throw InputError(Problem{source, "", fmt::format("\"{}\"", name),
                             fmt::format("one of: {}", fmt::join(kBoardKinds, ", "))});
  }
  return static_cast<Board::Kind>(found - kBoardKinds.begin());
}

}  // namespace throng::calibrate
