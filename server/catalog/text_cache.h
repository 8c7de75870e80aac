// Cache of texts, for many clients that request the same.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace throng::server {

/// Texts of one revision of everything: with the next, all are forgotten. Safe to use from many
/// threads.
class TextCache {
 public:
  using Text = std::shared_ptr<const std::string>;

  /// Null when there is none of this revision.
  Text find(std::uint64_t revision, const std::string& name) const;

  /// `revision` is what it was before the text was made.
  void put(std::uint64_t revision, const std::string& name, Text text);

 private:
  mutable std::mutex mutex_;
  std::uint64_t revision_ = 0;
  std::unordered_map<std::string, Text> texts_;
};

}  // namespace throng::server
