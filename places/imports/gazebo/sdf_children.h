// Children of elements of libsdformat, whose GetElement() makes those that are missing.
#pragma once

#include <sdf/Element.hh>
#include <string>

namespace throng::imports {

/// The first child of this name; null if there is none, or no parent.
inline sdf::ElementPtr find_child(const sdf::ElementPtr& parent, const std::string& name) {
  return parent && parent->HasElement(name) ? parent->GetElement(name) : nullptr;
}

/// Calls `call` with each child of this name; `parent` may be null.
template <typename Call>
void for_each_child(const sdf::ElementPtr& parent, const std::string& name, const Call& call) {
  for (auto child = find_child(parent, name); child; child = child->GetNextElement(name)) {
    call(child);
  }
}

}  // namespace throng::imports
