// The parts of scenarios::check(), one per concern.
#pragma once

#include <string>
#include <vector>

#include "places/scenarios/check/finding.h"
#include "places/scenarios/check/outline.h"
#include "places/scenarios/check/survey.h"

namespace throng::scenarios {

/// Collects findings about one scenario file.
class Findings {
 public:
  Findings(std::string source, bool of_blueprint)
      : source_(std::move(source)), of_blueprint_(of_blueprint) {}

  /// The text for those who wrote a blueprint, or the one for those who wrote the crowd's files.
  const char* either(const char* blueprint, const char* crowd_files) const {
    return of_blueprint_ ? blueprint : crowd_files;
  }
  void error(std::string where, std::string found, std::string expected, std::string remedy) {
    add(Severity::error, std::move(where), std::move(found), std::move(expected),
        std::move(remedy));
  }
  void warning(std::string where, std::string found, std::string expected, std::string remedy) {
    add(Severity::warning, std::move(where), std::move(found), std::move(expected),
        std::move(remedy));
  }
  void add(Severity severity, std::string where, std::string found, std::string expected,
           std::string remedy) {
    found_.push_back({severity,
                      {source_, std::move(where), std::move(found), std::move(expected)},
                      std::move(remedy)});
  }
  std::vector<Finding> take() { return std::move(found_); }

 private:
  std::string source_;
  bool of_blueprint_;
  std::vector<Finding> found_;
};

void check_sizes(const world::Scenario& scenario, Findings& findings);
/// Checks that the rendered ground covers Scenario::inside.
void check_drawn_ground(const world::Scenario& scenario, Findings& findings);
void check_buildings(const world::Scenario& scenario, Findings& findings);
void check_drones(const world::Scenario& scenario, Findings& findings);
/// Checks that people start at walkable positions from which they can get out.
void check_people(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                  Findings& findings);
/// Checks that visible buildings are also obstacles for people.
void check_walls(const world::Scenario& scenario, const Routes& routes, Findings& findings);
/// Checks for ground on which people can stand but that they cannot leave.
void check_ground(const world::Scenario& scenario, const Routes& routes, Findings& findings);
/// Checks for people who start or arrive outside of Scenario::inside, where metrics ignore them.
void check_outsiders(const world::Scenario& scenario, const LoadedCrowd& loaded,
                     Findings& findings);
/// Checks whether people can leave the scenario without passing an exit.
void check_outline(const world::Scenario& scenario, const OutlineSurvey& outline,
                   Findings& findings);
/// Checks where the exits are and what they lead to. `is_closed`: the outline has no gaps.
void check_exits(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                 bool is_closed, Findings& findings);

}  // namespace throng::scenarios
