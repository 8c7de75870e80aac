// The module's public header: Gazebo's worlds and OpenStreetMap's extracts read, populated, and
// written as scenarios.
#pragma once

#include "world/imports/gazebo/sdf_world.h"
#include "world/imports/osm/osm_map.h"
#include "world/imports/parts/populate.h"
#include "world/imports/parts/scenario_writer.h"
