// The module's public header: Gazebo's worlds and OpenStreetMap's extracts read, populated, and
// written as scenarios.
#pragma once

#include "imports/osm_map.h"
#include "imports/populate.h"
#include "imports/scenario_writer.h"
#include "imports/sdf_world.h"
