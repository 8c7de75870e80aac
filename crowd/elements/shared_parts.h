// Cache of resources that several elements of the files share.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>

namespace throng::crowd {

/// Keeps created objects by their type and a key, such as a file's path. Not thread-safe.
class SharedParts {
 public:
  /// Returns the object with this key; calls make(), which returns a std::shared_ptr<Part>, if
  /// there is none.
  template <typename Part, typename Make>
  std::shared_ptr<Part> get(const std::string& key, const Make& make) {
    std::shared_ptr<void>& part = parts_[{std::type_index(typeid(Part)), key}];
    if (!part) part = make();
    return std::static_pointer_cast<Part>(part);
  }

 private:
  std::map<std::pair<std::type_index, std::string>, std::shared_ptr<void>> parts_;
};

}  // namespace throng::crowd
