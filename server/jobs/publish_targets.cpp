#include "server/jobs/publish_targets.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"

namespace throng::server {

PublishTargets::PublishTargets(const std::vector<std::string>& allowed) {
  for (const std::string& text : allowed) {
    allowed_.push_back(bucket::parse_address(text, "--publish-to", ""));
  }
}

void PublishTargets::require(const std::string& address) const {
  if (address.empty()) return;
  constexpr const char* kPointer = "/outputs/publish";
  const bucket::Address wanted = bucket::parse_address(address, "", kPointer);
  const bool is_allowed =
      std::any_of(allowed_.begin(), allowed_.end(),
                  [&](const bucket::Address& allowed) { return wanted.is_within(allowed); });
  if (is_allowed) return;
  std::string expected;
  for (const bucket::Address& one : allowed_) {
    expected += fmt::format("{}{} or below", expected.empty() ? "" : ", ", one.text());
  }
  if (expected.empty()) {
    expected = "none: this service publishes nothing (throng serve --publish-to)";
  }
  throw InputError(Problem{"", kPointer, fmt::format("\"{}\"", address), expected});
}

}  // namespace throng::server
