// Moments and commands of a flight of two drones, d1 and d2, in steps of 0.1 s.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>

#include "live/loop/moment.h"
#include "spec/live/commands.h"

namespace throng::live {

inline std::shared_ptr<const Moment> moment(int step) {
  constexpr double kDtS = 0.1;
  auto moment = std::make_shared<Moment>();
  moment->time_s = step * kDtS;
  moment->dt_s = kDtS;
  return moment;
}

inline Commands read(const char* text) {
  return commands_from_json(nlohmann::json::parse(text), {{"d1"}, {"d2"}});
}

}  // namespace throng::live
