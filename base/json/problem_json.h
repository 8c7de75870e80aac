// Conversion of problems to and from JSON, for the exchange between processes.
#pragma once

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng {

inline void to_json(nlohmann::json& json, const Problem& problem) {
  json = {{"source", problem.source},
          {"where", problem.where},
          {"found", problem.found},
          {"expected", problem.expected}};
}

inline void from_json(const nlohmann::json& json, Problem& problem) {
  problem = {json.value("source", ""), json.value("where", ""), json.value("found", ""),
             json.value("expected", "")};
}

}  // namespace throng
