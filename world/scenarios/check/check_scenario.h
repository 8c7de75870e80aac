// The parts of scenarios::check(), each for one concern.
#pragma once

#include <string>
#include <vector>

#include "world/scenarios/check/check.h"
#include "world/scenarios/check/survey.h"

namespace throng::scenarios {

/// Collects findings about one scenario file.
class Findings {
 public:
  explicit Findings(std::string source) : source_(std::move(source)) {}
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
  std::vector<Finding> found_;
};

void check_sizes(const world::Scenario& scenario, Findings& findings);
/// Whether ground is drawn wherever people are inside.
void check_drawn_ground(const world::Scenario& scenario, Findings& findings);
void check_buildings(const world::Scenario& scenario, Findings& findings);
void check_drones(const world::Scenario& scenario, Findings& findings);
/// Whether people start where they can be and can get out from there.
void check_people(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                  Findings& findings);
/// Whether buildings, which are seen, are also in people's way.
void check_walls(const world::Scenario& scenario, const Routes& routes, Findings& findings);
/// Whether there is ground that people can stand on but not leave.
void check_ground(const world::Scenario& scenario, const Routes& routes, Findings& findings);
/// Whether people start or arrive outside of the scenario, where no figure counts them.
void check_outsiders(const world::Scenario& scenario, const LoadedCrowd& loaded,
                     Findings& findings);
/// Whether people can get out of the scenario without passing an exit.
void check_outline(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                   Findings& findings);
void check_exits(const world::Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                 Findings& findings);

}  // namespace throng::scenarios
