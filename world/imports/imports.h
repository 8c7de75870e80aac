// The module's public header: read_sdf() and read_osm() read Gazebo's worlds and OpenStreetMap's
// extracts, populate() adds people, and write_imported_scenario() writes the scenario. read_robot()
// reads robots, and airframe_json() makes airframes of them.
#pragma once

#include "world/imports/gazebo/sdf_world.h"
#include "world/imports/osm/osm_map.h"
#include "world/imports/parts/populate.h"
#include "world/imports/parts/scenario_writer.h"
#include "world/imports/robots/airframe_json.h"
#include "world/imports/robots/robot_reader.h"
