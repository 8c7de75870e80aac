// The module's public header: Gazebo's worlds and OpenStreetMap's extracts read, populated, and
// written as scenarios.
#pragma once

#include "places/imports/gazebo/sdf_world.h"
#include "places/imports/osm/osm_map.h"
#include "places/imports/parts/populate.h"
#include "places/imports/parts/scenario_writer.h"
