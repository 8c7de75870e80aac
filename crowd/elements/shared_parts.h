// Resources that several elements of the files share and that are made once.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>

namespace throng::crowd {

/// Remembers what was made, by its type and a key such as a file's path.
class SharedParts {
 public:
  /// The Part of this key; make() makes a std::shared_ptr to it if there is none yet.
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
