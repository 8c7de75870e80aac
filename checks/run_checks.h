// Checks of files per run, for consistency and against the images' records. add() is called for
// each image in the order of the COCO file.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "checks/exit_series.h"
#include "checks/findings.h"
#include "checks/ground_truth_checks.h"
#include "formats/dataset/dataset.h"
#include "formats/files/csv_table.h"

namespace throng::checks {

/// Checks exits/RUN.csv: its columns against each other, over time and against the images' `exits`,
/// and the polygons of the latter against each other.
class ExitsCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  /// Checks that most people leave by the exit that their last records name.
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

 private:
  struct Run {
    std::map<std::string, ExitSeries> exits;
    std::vector<std::string> order;
    std::map<std::int64_t, std::set<std::int64_t>> counted;      ///< tracks by frame
    std::map<std::int64_t, std::map<std::string, int>> in_zone;  ///< people by frame and exit
    std::map<std::int64_t, std::string> wanted;                  ///< last exit in records, by track
    /// Exits in the records by frame and track; "" without an exit.
    std::map<std::int64_t, std::map<std::int64_t, std::string>> headed;
    std::string scenario;
  };
  /// A polygon on the ground (m) from the image that shows it most precisely: corners are rounded
  /// to 0.01 px, which may be meters on distant ground.
  struct Outline {
    std::vector<Eigen::Vector2d> corners;
    std::vector<std::array<Eigen::Vector2d, 4>> rounding;  ///< per corner: bounds of its position
    double rounding_m = 0;                                 ///< max distance of these bounds
  };
  struct ExitOutlines {
    Outline door;
    Outline zone;
  };

  Run& read(const formats::DatasetInfo& info, const std::string& run, Findings& findings);
  static Outline exit_outline(const camera::Camera& camera, const nlohmann::json& polygon);
  static double max_corner_distance_px(const camera::Camera& camera, const Outline& place,
                                       const nlohmann::json& polygon);
  void check_polygons(const formats::Image& image, const nlohmann::json& exit, Findings& findings);
  static std::string shape_fault(const std::string& id, const ExitOutlines& place);
  static void check_values(const std::string& file, const formats::Image& image,
                           const nlohmann::json& exit, const Run& run, Findings& findings);
  void count_everybody(const formats::DatasetInfo& info, const std::string& name, const Run& run,
                       Findings& findings) const;
  void count_people(const std::string& file, const formats::Image& image, Run& run,
                    Findings& findings) const;

  std::map<std::string, Run> runs_;
  /// By scenario and exit, because the outline is the same in all runs of a scenario.
  std::map<std::pair<std::string, std::string>, ExitOutlines> places_;
};

/// Compares fields/RUN/FRAME.npy with the people that cameras see.
class FieldsCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

 private:
  struct Walker {
    Eigen::Vector2d position;
    Eigen::Vector2d velocity;
  };
  std::map<std::string, std::map<std::int64_t, std::map<std::int64_t, Walker>>> runs_;
};

/// Compares counts/RUN.csv and the images' `zones` with the people that cameras see.
class CountsCheck : public GroundTruthCheck {
 public:
  using Positions = std::map<std::int64_t, Eigen::Vector2d>;  ///< positions by track

  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

 private:
  struct Visible {
    std::int64_t id = 0;
    nlohmann::json zones;
    std::vector<Eigen::Vector2d> places;  ///< positions of the visible people
  };
  static void check_visible(const std::string& id, const std::vector<Eigen::Vector2d>& corners,
                            const Visible& image, std::size_t zone, Findings& findings);

  std::map<std::string, std::map<std::int64_t, Positions>> seen_;  ///< by run and frame
  std::map<std::string, std::vector<Visible>> images_;             ///< by run
};

/// Compares trajectories/RUN.npy with the people in the images and with the max speed of people.
class TrajectoriesCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

  struct Seen {
    Eigen::Vector2d position;
    double heading_rad = 0;
    std::string behavior;
  };
  struct Frame {
    double time_s = 0;
    std::map<std::int64_t, Seen> people;  ///< by track
  };

 private:
  std::map<std::string, std::map<std::int64_t, Frame>> runs_;  ///< by run and frame
};

/// Compares trajectories/RUN.npy with the images' views: everybody there has a record, and people
/// whom no image shows are like the others.
class UnseenCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

  struct View {
    std::int64_t image = 0;
    camera::Camera camera;
    std::set<std::int64_t> tracks;  ///< those with a record, seen or hidden
  };
  struct Frame {
    std::vector<View> views;      ///< of images without a rolling shutter
    std::set<std::int64_t> seen;  ///< tracks of people with an annotation
  };

 private:
  std::map<std::string, std::map<std::int64_t, Frame>> runs_;  ///< by run and frame
};

/// Compares events/RUN.jsonl with the frames and the people in the images.
class EventsCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

  struct Frame {
    double time_s = 0;
    std::map<std::int64_t, Eigen::Vector2d> people;  ///< positions by track
  };
  using Frames = std::map<std::int64_t, Frame>;

 private:
  std::map<std::string, Frames> runs_;
};

/// Compares actions/RUN.csv with the actions in the images' records.
class ActionsCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

 private:
  struct Seen {
    std::int64_t id = 0;  ///< of the annotation
    std::int64_t track_id = 0;
    double time_s = 0;
    std::set<std::string> actions;
  };

  void check_names(const formats::Person& person, const nlohmann::json& names,
                   Findings& findings) const;
  static void check_together(const formats::Person& person,
                             const std::map<std::int64_t, const formats::Person*>& by_track,
                             Findings& findings);
  static void check_table(const formats::CsvTable& table, const std::string& file,
                          const std::vector<Seen>& seen, Findings& findings);
  void check_groups(const formats::CsvTable& table, const std::string& file,
                    Findings& findings) const;

  std::optional<bool> knows_postures_;             ///< whether states tell who sits
  std::map<std::string, std::vector<Seen>> seen_;  ///< by run
  std::map<std::int64_t, nlohmann::json> groups_;  ///< of tracks that images show
};

/// Checks that values are constant: a run's environment, a camera's lens, a person's attributes and
/// bones.
class ConstancyCheck {
 public:
  explicit ConstancyCheck(const nlohmann::json& manifest) : manifest_(manifest) {}
  void add(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings);
  void finish(const formats::DatasetInfo& info, Findings& findings);

 private:
  void check_environment(const formats::Image& image, Findings& findings);
  void check_camera(const formats::Image& image, Findings& findings);
  void check_person(const formats::Person& person, Findings& findings);
  void check_track(const formats::Image& image, const formats::Person& person, Findings& findings);
  void check_sexes(Findings& findings) const;

  const nlohmann::json& manifest_;
  std::map<std::string, nlohmann::json> lenses_;       ///< by run and camera
  std::map<std::int64_t, std::vector<double>> bones_;  ///< m, by track
  std::map<std::string, std::pair<std::int64_t, nlohmann::json>> characters_;
  std::set<std::int64_t> tracks_;
  std::map<std::string, std::set<std::int64_t>> tracks_of_run_;
  std::map<std::string, std::set<std::int64_t>> frames_;  ///< by run and camera
};

/// Checks positions and sizes of vehicles in the images of a run.
class VehicleCheck {
 public:
  void add(const formats::Image& image, Findings& findings);

 private:
  std::map<std::int64_t, nlohmann::json> poses_;  ///< by track
};

/// Checks the hazards in the images of a run and the danger to people.
class HazardCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings);

 private:
  struct Known {
    double time_s = 0;
    nlohmann::json record;
  };
  struct Inside {
    double time_s = 0;
    double inside_s = 0;
  };

  void check_hazard(const formats::Image& image, const nlohmann::json& hazard, Findings& findings);
  void check_danger(const formats::Image& image, const formats::Person& person,
                    const nlohmann::json& hazards, Findings& findings);

  std::map<std::pair<std::string, int>, Known> last_;  ///< by run and hazard
  std::map<std::int64_t, Inside> inside_;              ///< by track
};

/// Compares hazard_opacity/ with the hazards in the images of a run.
class HazardOpacityCheck : public GroundTruthCheck {
 public:
  void add_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                  const Pixels& pixels, Findings& findings) override;
  void finish(const formats::DatasetInfo& info, Findings& findings) override;

 private:
  /// Opacity that none of an image's hazards explains.
  struct Unexplained {
    std::string run;
    std::string file;
    std::string record;
    std::string text;
  };

  std::set<std::string> runs_with_hazards_;
  std::vector<Unexplained> without_hazard_;
};

/// Checks that hazards in the open show the fire, smoke and gas of their kind.
class HazardSightCheck : public GroundTruthCheck {
 public:
  void add_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                  const Pixels& pixels, Findings& findings) override;
};

/// Checks that a person who is recorded in the previous and the next frame is recorded in the frame
/// between.
class PresenceCheck {
 public:
  void add(const formats::Image& image, Findings& findings);

 private:
  struct Moment {
    formats::Image image;  ///< without images and masks
  };
  std::map<std::string, std::vector<Moment>> last_;  ///< last two frames of each camera
};

/// Compares metrics.json with metrics/RUN.json and the tables that it summarizes.
void check_metrics(const formats::DatasetInfo& info, const nlohmann::json& manifest,
                   Findings& findings);

/// Compares an image's record with the manifest's job: camera, sensor, light, weather and wind.
void check_job(const nlohmann::json& manifest, const formats::Image& image, Findings& findings);

/// Compares previews/ with the images and boxes that they show.
void check_preview(const formats::DatasetInfo& info, const formats::Image& image,
                   Findings& findings);

}  // namespace throng::checks
