// What takes long to make, for the many clients that ask for the same.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace throng::server {

/// Things by name: the last few that were asked for are kept, and all that somebody uses. Safe to
/// use from many threads; each thing is made once.
template <typename Thing>
class Recent {
 public:
  explicit Recent(std::size_t kept) : most_(kept) {}

  /// The thing of the name; what `make` returns when there is none.
  template <typename Make>
  std::shared_ptr<const Thing> get(const std::string& name, const Make& make) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const Thing> thing = used_[name].lock();
    if (!thing) {
      std::erase_if(used_, [](const auto& entry) { return entry.second.expired(); });
      thing = std::make_shared<const Thing>(make());
      used_[name] = thing;
    }
    std::erase(kept_, thing);
    kept_.push_back(thing);
    if (kept_.size() > most_) kept_.pop_front();
    return thing;
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const Thing>> used_;
  std::deque<std::shared_ptr<const Thing>> kept_;  ///< the last one last
};

}  // namespace throng::server
