// Layouts that programs in other languages share: python/throng/layouts.json.
#pragma once

#include <string>

namespace throng::layouts {

/// The flags of agents, the binary records of live flights and trajectories, the measures of a
/// plan's drawing and the columns of tables as JSON. job_schema writes it for the Python package
/// and for Studio.
std::string layouts_text();

}  // namespace throng::layouts
