#include "crowd/behavior/stress.h"

#include <algorithm>
#include <cmath>

namespace throng::crowd {

namespace {

constexpr std::array<Property, 4> kProperty = {Property::neighbor_dist, Property::max_neighbors,
                                               Property::radius, Property::pref_speed};
constexpr float kMinHorizon = 0.01F;  // s

float limited(int affected, float value) {
  if (affected == Stress::time_horizon) return std::max(value, kMinHorizon);
  const PropertySpec& spec = property_spec(kProperty[static_cast<std::size_t>(affected)]);
  value = std::clamp(value, spec.min * spec.file_unit, spec.max * spec.file_unit);
  return affected == Stress::max_neighbors ? std::floor(value) : value;
}

}  // namespace

Stress::Stress(const Crowd& crowd) : patients_(crowd.agents.count()) {
  const auto& names = crowd.model_parameter_names;
  const auto tau = std::find(names.begin(), names.end(), "tau");
  if (tau != names.end()) time_horizon_ = static_cast<int>(tau - names.begin());
}

float* Stress::find_value(Crowd& crowd, std::size_t agent, int affected) const {
  if (affected != time_horizon) {
    return &crowd.agents[kProperty[static_cast<std::size_t>(affected)]][agent];
  }
  if (time_horizon_ < 0) return nullptr;
  return &crowd.agents.model_parameters[static_cast<std::size_t>(time_horizon_)][agent];
}

void Stress::begin(std::size_t agent, const Stressor& stressor, const Deltas& deltas) {
  Patient& patient = patients_[agent];
  // A value that nobody can have, so that all of them are taken for new bases.
  if (patient.mode == Mode::calm) patient.values.fill({0, -1});
  patient.mode = Mode::stressed;
  patient.stressor = &stressor;
  patient.deltas = deltas;
}

void Stress::end(Crowd& crowd, std::size_t agent, Exit exit, float cool_s) {
  Patient& patient = patients_[agent];
  if (patient.mode == Mode::calm) return;
  switch (exit) {
    case Exit::reset:
      calm(crowd, agent, patient);
      break;
    case Exit::keep_going:
      break;
    case Exit::pause:
      patient.mode = Mode::held;
      break;
    case Exit::cool_down:
      patient.mode = Mode::cooling;
      patient.cooling = 1 / std::max(cool_s, 1e-3F);
      break;
  }
}

void Stress::after_motion(Crowd& crowd, Machine&) {
  const auto dt_s = static_cast<float>(crowd.dt_s);
  for (std::size_t i = 0; i < patients_.size(); ++i) {
    Patient& patient = patients_[i];
    if (patient.mode == Mode::calm || crowd.agents.present[i] == 0) continue;
    if (patient.mode == Mode::stressed) {
      patient.level =
          std::clamp(patient.stressor->next_level(crowd, i, patient.level, dt_s), 0.0F, 1.0F);
    }
    if (patient.mode == Mode::cooling) patient.level -= patient.cooling * dt_s;
    if (patient.mode == Mode::cooling && patient.level <= 0) {
      calm(crowd, i, patient);
    } else {
      apply(crowd, i, patient);
    }
  }
}

void Stress::apply(Crowd& crowd, std::size_t agent, Patient& patient) const {
  for (int i = 0; i < kAffectedCount; ++i) {
    float* value = find_value(crowd, agent, i);
    if (value == nullptr) continue;
    const auto index = static_cast<std::size_t>(i);
    Value& known = patient.values[index];
    if (*value != known.applied) known.base = *value;  // somebody else has changed it
    *value = limited(i, known.base * (1 + patient.level * patient.deltas[index]));
    known.applied = *value;
  }
}

void Stress::calm(Crowd& crowd, std::size_t agent, Patient& patient) const {
  for (int i = 0; i < kAffectedCount; ++i) {
    float* value = find_value(crowd, agent, i);
    if (value == nullptr) continue;
    const Value& known = patient.values[static_cast<std::size_t>(i)];
    if (*value == known.applied) *value = known.base;
  }
  patient.mode = Mode::calm;
  patient.level = 0;
}

Stress& stress_process(BehaviorContext& context) {
  if (context.stress == nullptr) {
    auto made = std::make_unique<Stress>(context.crowd);
    context.stress = made.get();
    context.processes.push_back(std::move(made));
  }
  return *context.stress;
}

}  // namespace throng::crowd
