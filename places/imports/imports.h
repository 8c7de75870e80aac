// The module's public header: read_sdf() and read_osm() read Gazebo's worlds and OpenStreetMap's
// extracts, populate() adds people, and write_imported_scenario() writes the scenario. read_robot()
// reads robots, and airframe_json() makes airframes of them.
#pragma once

#include "places/imports/gazebo/sdf_world.h"
#include "places/imports/osm/osm_map.h"
#include "places/imports/parts/populate.h"
#include "places/imports/parts/scenario_writer.h"
#include "places/imports/robots/airframe_json.h"
#include "places/imports/robots/robot_reader.h"
