#include "spec/documents/layouts.h"

#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <string_view>

#include "base/json/field_table.h"
#include "spec/annotate/table_columns.h"
#include "spec/layouts/live_records.h"
#include "spec/layouts/plan_sheet.h"
#include "spec/layouts/trajectory_records.h"
#include "spec/live/messages.h"
#include "world/trace.h"
#include "world/trace_layout.h"

namespace throng::layouts {

using nlohmann::ordered_json;

namespace {

/// Fields as NumPy describes them: [name, type, count].
ordered_json record(std::span<const BinaryField> fields) {
  ordered_json list = ordered_json::array();
  for (const BinaryField& field : fields) list.push_back({field.name, field.type, field.count});
  return list;
}

ordered_json columns(std::string_view header) {
  ordered_json list = ordered_json::array();
  std::istringstream stream{std::string(header)};
  for (std::string name; std::getline(stream, name, ',');) list.push_back(name);
  return list;
}

ordered_json message_types() {
  ordered_json types = ordered_json::object();
  for (const auto& [type, name] : live::kMessageTypes) {
    types[std::string(1, static_cast<char>(type))] = name;
  }
  return types;
}

}  // namespace

std::string layouts_text() {
  const ordered_json document = {
      {"trace_version", world::kTraceVersion},
      {"agent_roles",
       {{"person", static_cast<int>(world::AgentRole::person)},
        {"disaster", static_cast<int>(world::AgentRole::disaster)},
        {"absent", static_cast<int>(world::AgentRole::absent)},
        {"attacker", static_cast<int>(world::AgentRole::attacker)},
        {"spectator", static_cast<int>(world::AgentRole::spectator)}}},
      {"agent_flags",
       {{"present", world::kPresent},
        {"panicked", world::kPanicked},
        {"fallen", world::kFallen},
        {"following", world::kFollowing}}},
      {"live",
       {{"version", kLiveVersion},
        {"message_types", message_types()},
        {"max_message_bytes", live::kMaxMessageBytes},
        {"state_head", record(kStateHeadFields)},
        {"state_flags", {{"paused", kIsPaused}}},
        {"drone", record(kDroneFields)},
        {"drone_flags",
         {{"beacon", kHasBeacon}, {"on_mission", kIsOnMission}, {"running", kIsRunning}}},
        {"person", record(kPersonFields)},
        {"yaw_parts", kYawParts},
        {"image_head", record(kImageHeadFields)}}},
      {"trajectories",
       {{"version", kTrajectoriesVersion},
        {"head", record(kTrajectoriesHeadFields)},
        {"agent", record(kTrajectoryFields)},
        {"absent", kAbsent}}},
      {"plan",
       {{"plan_px", kPlanPx},
        {"border_px", kPlanBorderPx},
        {"title_px", kPlanTitlePx},
        {"legend_line_px", kLegendLinePx},
        {"legend_column_px", kLegendColumnPx},
        {"legend_entries", kLegendEntries},
        {"min_width_px", kMinPlanWidthPx}}},
      {"tables",
       {{"actions", columns(annotate::kActionColumns)},
        {"counts", columns(annotate::kCountColumns)},
        {"exits", columns(annotate::kExitColumns)},
        {"sensors", columns(annotate::kSensorColumns)}}}};
  return fields::schema_text(document);
}

}  // namespace throng::layouts
