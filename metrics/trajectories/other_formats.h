// Readers of trajectory files that are neither text nor tables.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "metrics/trajectories/recorded.h"

namespace throng::metrics {

/// Reads Menge's .scb from version 2.0 on (1.0 does not contain the frame duration); agents are
/// people with ids from 1. Throws InputError and EnvironmentError.
Recorded read_scb(const std::filesystem::path& file);

/// Reads JuPedSim's SQLite database: tables `trajectory_data` (frame, id, pos_x, pos_y in m) and
/// `metadata` (fps). Throws InputError.
Recorded read_database(const std::filesystem::path& file, std::optional<double> frames_per_s);

/// Reads HDF5 of the Pedestrian Dynamics Data Archive of Jülich: a dataset `trajectory` of rows
/// with id, frame, x, y, and its attributes `fps`, `x` and `y`, which state units. `unit_m`: the
/// user's unit, which overrides them. Throws InputError.
Recorded read_archive_hdf5(const std::filesystem::path& file, std::optional<double> frames_per_s,
                           std::optional<double> unit_m);

/// Reads SUMO's FCD output (XML): persons of time steps; vehicles are left out. Throws InputError,
/// also for longitudes and latitudes.
Recorded read_fcd(std::string_view text, const std::string& name,
                  std::optional<double> frames_per_s);

/// Reads JSON: Pathfinder's, which has an object of times for each person, or lines of TrajNet++
/// ({"track": {"f": frame, "p": person, "x", "y"}}). Throws InputError.
Recorded read_json_trajectories(std::string_view text, const std::string& name,
                                std::optional<double> frames_per_s);

}  // namespace throng::metrics
