#include "world/disasters.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "world/json_reader.h"

namespace throng::world {

namespace {

constexpr double kDisasterFarthestM = 100'000;
constexpr double kMaxReachM = 1000;
constexpr double kMaxTimeS = 1e6;
constexpr int kMaxAgentIds = 1'000'000'000;

DisasterKind read_disaster_kind(const JsonValue& value) {
  const std::string word = value.text();
  const auto* const found = std::find(kDisasterKinds.begin(), kDisasterKinds.end(), word);
  if (found != kDisasterKinds.end()) {
    return static_cast<DisasterKind>(found - kDisasterKinds.begin());
  }
  value.reject(fmt::format("one of: {}", fmt::join(kDisasterKinds, ", ")));
  return DisasterKind::explosion;
}

}  // namespace

double Disaster::reach_m(double time_s) const {
  if (time_s < start_s) return 0;
  return std::min(radius_m + growth_mps * (time_s - start_s), std::max(radius_m, max_radius_m));
}

Disaster read_disaster(const JsonValue& item, int agent) {
  Disaster disaster;
  disaster.kind = read_disaster_kind(item["kind"]);
  disaster.agent = agent;
  disaster.position = item["position"].vector2(kDisasterFarthestM);
  if (item["start_s"].exists()) disaster.start_s = item["start_s"].number(0, kMaxTimeS);
  if (item["radius_m"].exists()) disaster.radius_m = item["radius_m"].number(0.1, kMaxReachM);
  if (item["growth_mps"].exists()) disaster.growth_mps = item["growth_mps"].number(0, 100);
  const JsonValue max_radius = item.renamed("max_radius_m", "most_m");
  disaster.max_radius_m = max_radius.exists() ? max_radius.number(0.1, kMaxReachM) : kMaxReachM;
  return disaster;
}

std::vector<Disaster> read_disasters(const JsonValue& list) {
  std::vector<Disaster> disasters;
  for (const JsonValue& item : list.items()) {
    item.fields({"kind", "agent", "position"},
                {"start_s", "radius_m", "growth_mps", "max_radius_m"}, {"most_m"});
    const int agent = item["agent"].integer(0, kMaxAgentIds);
    const bool taken = std::any_of(disasters.begin(), disasters.end(),
                                   [&](const Disaster& other) { return other.agent == agent; });
    if (taken) item["agent"].reject("an agent that stands for no other disaster");
    disasters.push_back(read_disaster(item, agent));
  }
  return disasters;
}

}  // namespace throng::world
