#include "metrics/people.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace throng::metrics {

namespace {

/// What the names of states say, by their numbers.
struct States {
  std::vector<bool> follows;
  std::vector<bool> is_down;

  explicit States(const world::TraceHeader& header) {
    for (std::string name : header.state_names) {
      is_down.push_back(world::is_down(name));
      for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      follows.push_back(name.find("follow") != std::string::npos);
    }
  }
};

PersonRecord record_of(const world::Trace& trace, std::size_t agent, const world::Rectangle& inside,
                       const States& states) {
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
      record.hurt_s.reset();
      return record;
    }
    const std::uint8_t state = trace.state[at];
    const bool is_known = state < states.follows.size();
    if (!is_known || !states.is_down[state]) {
      record.hurt_s.reset();
    } else if (!record.hurt_s) {
      record.hurt_s = trace.time_s[step];
    }
    const bool following = is_known && states.follows[state];
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
  const States states(trace.header);
  std::vector<PersonRecord> records;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    PersonRecord record = record_of(trace, agent, inside, states);
    if (record.first_step < trace.steps()) records.push_back(record);
  }
  return records;
}

}  // namespace throng::metrics
