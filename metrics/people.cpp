#include "metrics/people.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace throng::metrics {

namespace {

std::vector<bool> following_states(const world::TraceHeader& header) {
  std::vector<bool> follows;
  for (std::string name : header.state_names) {
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    follows.push_back(name.find("follow") != std::string::npos);
  }
  return follows;
}

PersonRecord record_of(const world::Trace& trace, std::size_t agent, const world::Rectangle& inside,
                       const std::vector<bool>& follows) {
  PersonRecord record;
  record.agent = agent;
  record.first_step = trace.steps();
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    const std::size_t at = trace.at(step, agent);
    const bool present = trace.present(step, agent);
    if (record.first_step == trace.steps()) {
      if (!present) continue;
      record.first_step = step;
      record.arrived_s = trace.time_s[step];
    }
    if (!present || !inside.contains(trace.position[at].cast<double>())) {
      record.escaped_s = trace.time_s[step];
      return record;
    }
    const bool following = trace.state[at] < follows.size() && follows[trace.state[at]];
    if (!record.noticed_s && (following || trace.exit_intent[at] >= 0)) {
      record.noticed_s = trace.time_s[step];
    }
    if (!following) continue;
    record.followed_s += trace.header.dt_s;
    if (step > record.first_step) {
      record.followed_m += (trace.position[at] - trace.position[trace.at(step - 1, agent)]).norm();
    }
  }
  return record;
}

}  // namespace

std::vector<PersonRecord> person_records(const world::Trace& trace,
                                         const world::Rectangle& inside) {
  const std::vector<bool> follows = following_states(trace.header);
  std::vector<PersonRecord> records;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    PersonRecord record = record_of(trace, agent, inside, follows);
    if (record.first_step < trace.steps()) records.push_back(record);
  }
  return records;
}

}  // namespace throng::metrics
