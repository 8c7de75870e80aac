// Every rule is provoked: a dataset is damaged in one way, and validation names that rule, file and
// record.
#include "formats/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "tests/formats/dataset_fixture.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Validate : public SmallDataset {
 protected:
  /// Changes the first annotation's record and lists the files anew.
  void change_person(const std::function<void(json&)>& change) {
    std::ifstream in(root_ / kCocoFile);
    std::string text;
    bool is_changed = false;
    for (std::string line; std::getline(in, line);) {
      if (!is_changed && line.find("\"track_id\"") != std::string::npos) {
        const bool has_comma = line.ends_with(',');
        json record = json::parse(line.substr(0, line.size() - (has_comma ? 1 : 0)));
        change(record);
        line = record.dump() + (has_comma ? "," : "");
        is_changed = true;
      }
      text += line + "\n";
    }
    write_file_atomically(root_ / kCocoFile, text);
    write_manifest();
  }

  void expect(const std::string& rule, const std::string& file, const std::string& record) const {
    const Validation validation = validate_dataset(root_);
    ASSERT_GT(validation.found, 0U) << rule << " was not noticed";
    bool is_found = false;
    for (const Finding& finding : validation.findings) {
      is_found |= finding.rule == rule && finding.file.find(file) != std::string::npos &&
                  finding.record.find(record) != std::string::npos && !finding.what.empty();
    }
    EXPECT_TRUE(is_found) << "found instead: " << validation.findings.front().rule << " in "
                          << validation.findings.front().file << ", "
                          << validation.findings.front().record << ": "
                          << validation.findings.front().what;
  }

  void expect_change(const std::string& rule, const std::function<void(json&)>& change) {
    SCOPED_TRACE(rule);
    const std::string whole = read_file(root_ / kCocoFile);
    change_person(change);
    expect(rule, kCocoFile, "annotation ");
    write_file_atomically(root_ / kCocoFile, whole);
    write_manifest();
  }
};

TEST_F(Validate, AGoodDatasetHasNoFaults) {
  const Validation validation = validate_dataset(root_);
  for (const Finding& finding : validation.findings) {
    ADD_FAILURE() << finding.rule << " " << finding.file << " " << finding.record << " "
                  << finding.what;
  }
  EXPECT_EQ(validation.images, 12U);
  EXPECT_GT(validation.annotations, 60U);
}

TEST_F(Validate, RecordsThatContradictThemselves) {
  expect_change("box-is-mask-bounds",
                [](json& r) { r["bbox"][0] = r["bbox"][0].get<double>() + 1; });
  expect_change("area-is-mask", [](json& r) { r["area"] = r["area"].get<int>() - 1; });
  expect_change("visibility-is-ratio",
                [](json& r) { r["visibility"] = r["visibility"].get<double>() / 2; });
  expect_change("visible-in-amodal", [](json& r) { r["area_amodal"] = 0; });
  expect_change("visible-in-amodal", [](json& r) { r["bbox_amodal"][0] = 1e4; });
  expect_change("box-not-empty", [](json& r) { r["bbox"][2] = 0; });
  expect_change("box-in-image", [](json& r) { r["bbox"][2] = 1000; });
  expect_change("iscrowd", [](json& r) { r["iscrowd"] = 1; });
  expect_change("keypoints", [](json& r) { r["num_keypoints"] = 18; });
  expect_change("position-in-box", [](json& r) { r["position"][0] = 500; });
  expect_change("mask-runs", [](json& r) { r["segmentation"]["counts"] = "00"; });
  expect_change("mask-size", [](json& r) { r["segmentation"]["size"][0] = 7; });
  expect_change("ids", [](json& r) { r["track_id"] = 5'000'001; });
  expect_change("ids", [](json& r) { r["id"] = r["id"].get<std::int64_t>() + 7; });
}

TEST_F(Validate, FilesThatAreMissingCutOffOrTooMany) {
  const fs::path image = root_ / "images/run000/d1/000001.jpg";
  fs::resize_file(image, 10);
  expect("manifest", "images/run000/d1/000001.jpg", "");
  write_manifest();
  expect("picture", "images/run000/d1/000001.jpg", "image 2");
  fs::remove(image);
  expect("manifest", "images/run000/d1/000001.jpg", "");
  std::ofstream(root_ / "stranger.txt") << "x";
  expect("manifest", "stranger.txt", "");
}

TEST_F(Validate, BytesThatWereChanged) {
  const fs::path map = root_ / "density/run000/d2/000000.npy";
  std::string bytes = read_file(map);
  bytes.back() = '\x41';  // the last value becomes at least 8
  write_file_atomically(map, bytes);
  expect("manifest", "density/run000/d2/000000.npy", "");
  write_manifest();
  expect("density-sum", "density/run000/d2/000000.npy", "");
}

TEST_F(Validate, PicturesOfInstancesThatAreNotTheMasks) {
  fs::copy_file(root_ / "instances/run000/d1/000000.png", root_ / "instances/run000/d1/000002.png",
                fs::copy_options::overwrite_existing);
  write_manifest();
  expect("instances-are-masks", "instances/run000/d1/000002.png", "");
}

TEST_F(Validate, DepthThatIsSomewhereElse) {
  render::Frame frame = annotate::empty_frame(160, 120);
  frame.depth_m.assign(frame.id.size(), 40.0F);
  write_file_atomically(root_ / "depth/run000/d1/000000.png", annotate::depth_png(frame));
  write_manifest();
  expect("depth", "depth/run000/d1/000000.png", "annotation ");
}

// In the fixture nobody is where flow would lead them: every frame is another scene.
TEST_F(Validate, FlowThatLeadsElsewhere) {
  annotations_.emplace_back("flow");
  write_manifest();
  expect("flow-leads-to-boxes", "flow/run000/d1/000000.png", "annotation ");
  write_file_atomically(root_ / "flow/run000/d1/000001.png",
                        annotate::png_bytes({160, 120, 3}, std::vector<std::uint16_t>(57600, 7)));
  write_manifest();
  expect("flow", "flow/run000/d1/000001.png", "pixel 0");
}

TEST_F(Validate, RecordsThatAreNone) {
  change_person([](json& r) { r.erase("position"); });
  expect("schema", kCocoFile, "line ");
}

TEST_F(Validate, AFolderThatIsNoDatasetIsRefused) {
  EXPECT_THROW(validate_dataset(folder_), InputError);
}

}  // namespace
}  // namespace throng::formats
