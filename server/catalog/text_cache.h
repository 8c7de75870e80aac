// Cache of responses that many clients request.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace throng::server {

/// Texts of one revision of the queue's state, at most 16 MiB; a new revision clears the cache.
/// Safe to use from many threads.
class TextCache {
 public:
  using Text = std::shared_ptr<const std::string>;

  /// The text of this name; null if there is none for this revision.
  Text find(std::uint64_t revision, const std::string& name) const;

  /// Stores a text. `revision` must have been read before the text was created.
  void put(std::uint64_t revision, const std::string& name, Text text);

 private:
  mutable std::mutex mutex_;
  std::uint64_t revision_ = 0;
  std::size_t bytes_ = 0;  ///< of all texts
  std::unordered_map<std::string, Text> texts_;
};

}  // namespace throng::server
