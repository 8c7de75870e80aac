// Options of `throng crowd`: a project file, overridden by the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "crowd/project/project.h"

namespace throng::cli {

struct CrowdArguments {
  std::string project_file;
  std::string scene_file;
  std::string behavior_file;
  std::string model;
  std::string compat;
  std::string separation;
  std::string constants;
  std::string output;
  std::string scb_version;
  std::optional<double> duration_s;
  std::optional<double> time_step_s;
  std::optional<int> sub_steps;
  std::optional<std::uint64_t> seed;
  std::string series_file;
  std::string positions_file;
  std::vector<double> positions_at_s;
  int threads = 0;
  bool quiet = false;
  bool list = false;
  bool json = false;
  bool markdown = false;
  std::string ignored_view;
  std::string ignored_dump_path;
  bool ignored_verbose = false;
};

/// The type of an option that names pedestrian models: TEXT:{ttc,orca,...}.
std::string model_words();

void add_crowd_options(CLI::App& command, CrowdArguments& arguments);

/// Reads the project and applies the command line's overrides. Throws InputError.
crowd::Project load_project(const CrowdArguments& arguments);

}  // namespace throng::cli
