// JTA (Fabbri et al. 2018): joints of tracked people, a JSON table per sequence. Frames count from
// 1; the third dimension is the camera's: x right, y down, z ahead, m.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "formats/dataset/image_camera.h"
#include "formats/dataset/joints.h"
#include "formats/export/makers.h"
#include "formats/export/sequences.h"

namespace throng::formats {

using skinning::Joint;

namespace {

/// JTA's joints 0 to 10 and 16 to 21. Between them are five along the back, from neck to pelvis.
constexpr std::array kUpper = {
    Joint::head_top,       Joint::head_center, Joint::neck,        Joint::right_clavicle,
    Joint::right_shoulder, Joint::right_elbow, Joint::right_wrist, Joint::left_clavicle,
    Joint::left_shoulder,  Joint::left_elbow,  Joint::left_wrist,
};
constexpr std::array kLower = {Joint::right_hip, Joint::right_knee, Joint::right_ankle,
                               Joint::left_hip,  Joint::left_knee,  Joint::left_ankle};
constexpr std::array kBack = {Joint::neck, Joint::chest, Joint::spine, Joint::pelvis};
constexpr std::size_t kBackJoints = 5;

struct JtaJoint {
  Eigen::Vector2d place;
  Eigen::Vector3d in_world;
  bool is_hidden = false;
  bool is_self_hidden = false;
};

class JtaPerson {
 public:
  JtaPerson(const Image& image, const Person& person)
      : camera_(image_camera(image)),
        joints_(read_joints(person.record)),
        in_world_(read_joints_3d(person.record)) {}

  JtaJoint at(Joint joint) const {
    const JointInImage& seen = joints_.at(index_from(joint));
    const Eigen::Vector3d& in_world = in_world_.at(index_from(joint));
    // Outside of the image it is where the camera would have it.
    const Eigen::Vector2d place = seen.is_inside() ? seen.place : projected(in_world);
    return {place, in_world, !seen.is_visible(), seen.is_self_hidden()};
  }

  /// From the first one below the neck to the last one at the pelvis, at equal steps.
  JtaJoint on_back(std::size_t number) const {
    const double along = static_cast<double>((number + 1) * (kBack.size() - 1)) / kBackJoints;
    const auto first = std::min(static_cast<std::size_t>(along), kBack.size() - 2);
    const double share = along - static_cast<double>(first);
    const JtaJoint a = at(kBack.at(first));
    const JtaJoint b = at(kBack.at(first + 1));
    const JtaJoint& nearer = share < 0.5 ? a : b;
    const Eigen::Vector3d in_world = (1 - share) * a.in_world + share * b.in_world;
    return {(1 - share) * a.place + share * b.place, in_world, nearer.is_hidden,
            nearer.is_self_hidden};
  }

 private:
  Eigen::Vector2d projected(const Eigen::Vector3d& in_world) const {
    const auto seen = camera_.project(in_world);
    return seen.visible ? Eigen::Vector2d(seen.pixel.array() + 0.5) : Eigen::Vector2d(-1, -1);
  }

  camera::Camera camera_;
  std::vector<JointInImage> joints_;
  std::vector<Eigen::Vector3d> in_world_;
};

class JtaExporter : public Exporter {
 public:
  JtaExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), tables_(output_) {}

  void add(const Image& image) override {
    if (image.run != run_) end_tables();
    run_ = image.run;
    const std::string split(to_string(image.split));
    output_.link(fmt::format("frames/{}/{}/{}.jpg", split, image.sequence(), image.frame + 1),
                 info_.root / image.file);
    const std::string path = fmt::format("annotations/{}/{}.json", split, image.sequence());
    bool is_new = false;
    OutputStream& table = tables_.of(image.run, path, is_new);
    open_.try_emplace(path, true);
    std::string rows;
    for (const Person& person : image.people) {
      if (!person.is_ignored) append_person(image, person, rows);
    }
    if (is_new) table.write("[");
    if (rows.empty()) return;
    bool& is_first = open_.at(path);
    table.write(is_first ? rows.substr(1) : rows);
    is_first = false;
  }

  void finish() override {
    end_tables();
    tables_.close();
  }

 private:
  void end_tables() {
    for (const auto& [path, is_first] : open_) {
      bool is_new = false;
      tables_.of(run_, path, is_new).write("]\n");
    }
    open_.clear();
  }

  static void append_person(const Image& image, const Person& person, std::string& rows) {
    const JtaPerson joints(image, person);
    int number = 0;
    const auto append = [&](const JtaJoint& joint) {
      const Eigen::Vector3d seen = image.R * joint.in_world + image.t;
      fmt::format_to(std::back_inserter(rows),
                     ",\n[{},{},{},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f},{},{}]", image.frame + 1,
                     person.number_in_run(), number++, joint.place.x(), joint.place.y(), seen.x(),
                     seen.y(), seen.z(), joint.is_hidden ? 1 : 0, joint.is_self_hidden ? 1 : 0);
    };
    for (const Joint joint : kUpper) append(joints.at(joint));
    for (std::size_t i = 0; i < kBackJoints; ++i) append(joints.on_back(i));
    for (const Joint joint : kLower) append(joints.at(joint));
  }

  const DatasetInfo& info_;
  Output output_;
  SequenceTexts tables_;
  std::string run_;
  std::map<std::string, bool> open_;  ///< tables of the run; whether they have no row yet
};

}  // namespace

ExporterPointer make_jta(const DatasetInfo& info, Output output) {
  return std::make_unique<JtaExporter>(info, std::move(output));
}

}  // namespace throng::formats
