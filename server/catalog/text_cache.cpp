#include "server/catalog/text_cache.h"

namespace throng::server {

TextCache::Text TextCache::find(std::uint64_t revision, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = revision_ == revision ? texts_.find(name) : texts_.end();
  return found == texts_.end() ? nullptr : found->second;
}

void TextCache::put(std::uint64_t revision, const std::string& name, Text text) {
  constexpr std::size_t kMaxTexts = 1000;
  constexpr std::size_t kMaxBytes = 16 << 20;
  const std::lock_guard lock(mutex_);
  if (text->size() > kMaxBytes) return;
  if (revision_ != revision || texts_.size() >= kMaxTexts || bytes_ + text->size() > kMaxBytes) {
    texts_.clear();
    bytes_ = 0;
    revision_ = revision;
  }
  bytes_ += text->size();
  texts_[name] = std::move(text);
}

}  // namespace throng::server
