// Shipped airframes by name.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "spec/sim/airframe.h"

namespace throng::sim::testing {

inline Airframe airframe_named(const std::string& name) {
  for (Airframe& frame : shipped_airframes()) {
    if (frame.name == name) return frame;
  }
  ADD_FAILURE() << "no airframe " << name;
  return {};
}

}  // namespace throng::sim::testing
