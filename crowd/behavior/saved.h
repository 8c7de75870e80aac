// Values of agents before an action changed them.
#pragma once

#include <cstddef>
#include <vector>

namespace throng::crowd {

/// Saves a value per agent if it must be restored when the agent leaves the state.
template <typename Value>
class Saved {
 public:
  Saved(bool restore, std::size_t agent_count) : values_(restore ? agent_count : 0) {}
  void save(std::size_t agent, const Value& value) {
    if (!values_.empty()) values_[agent] = value;
  }
  void restore(std::size_t agent, Value& value) const {
    if (!values_.empty()) value = values_[agent];
  }

 private:
  std::vector<Value> values_;
};

}  // namespace throng::crowd
