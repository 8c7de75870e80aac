// Every rule is provoked: a dataset is damaged in one way, and validation names that rule, file and
// record.
#include "checks/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/graphics/images/jpeg_writer.h"
#include "formats/dataset/mask.h"
#include "formats/dataset/raster_files.h"
#include "formats/files/npy.h"
#include "tests/formats/dataset_fixture.h"

namespace throng::checks {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Validate : public formats::SmallDataset {
 protected:
  /// Makes the dataset a sound one with this format and no other.
  void with_format(const std::string& format) {
    std::filesystem::remove_all(root_ / "formats");
    formats_ = {format};
    const formats::DatasetInfo described = info();
    formats::export_dataset(described, formats::choose_formats(formats_, described.annotations, ""),
                            root_ / "formats");
    write_manifest();
    const Validation validation = validate_dataset(root_);
    ASSERT_EQ(validation.found, 0U)
        << validation.findings.front().file << " " << validation.findings.front().what;
  }
  /// Changes the first record that begins with such a member, and lists the files again.
  void change_record(const std::string& begin, const std::function<void(json&)>& change) {
    change_lines(begin, [&](std::string line) {
      const bool has_comma = line.ends_with(',');
      json record = json::parse(line.substr(0, line.size() - (has_comma ? 1 : 0)));
      change(record);
      return record.dump() + (has_comma ? "," : "") + "\n";
    });
  }
  void change_lines(const std::string& begin,
                    const std::function<std::string(std::string)>& change) {
    std::ifstream in(root_ / formats::kCocoFile);
    std::string text;
    bool is_changed = false;
    for (std::string line; std::getline(in, line);) {
      if (!is_changed && line.starts_with("{\"id\":") && line.find(begin) != std::string::npos) {
        text += change(line);
        is_changed = true;
      } else {
        text += line + "\n";
      }
    }
    EXPECT_TRUE(is_changed);
    write_file_atomically(root_ / formats::kCocoFile, text);
    write_manifest();
  }
  void change_person(const std::function<void(json&)>& change) {
    change_record("\"image_id\":", change);
  }
  void change_image(const std::function<void(json&)>& change) {
    change_record("\"file_name\":", change);
  }
  void write(const std::string& path, const std::string& bytes) {
    write_file_atomically(root_ / path, bytes);
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
    const std::string whole = read_file(root_ / formats::kCocoFile);
    change_person(change);
    expect(rule, formats::kCocoFile, "annotation ");
    write_file_atomically(root_ / formats::kCocoFile, whole);
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

/// All 17 visible at one place.
json keypoints_at(double x, double y) {
  json keypoints = json::array();
  for (int i = 0; i < 17; ++i) {
    for (const double value : {x, y, 2.0}) keypoints.push_back(value);
  }
  return keypoints;
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
  expect_change("position", [](json& r) { r["position"][0] = 500; });
  expect_change("box-3d", [](json& r) { r["box_3d"][1] = r["box_3d"][1].get<double>() + 2; });
  expect_change("box-3d", [](json& r) {
    r["box_3d"][0] = r["box_3d"][0].get<double>() + 0.15;
    r["box_3d"][3] = r["box_3d"][4] = r["box_3d"][5] = 0.01;
  });
  expect_change("mask-runs", [](json& r) { r["segmentation"]["counts"] = "00"; });
  expect_change("mask-size", [](json& r) { r["segmentation"]["size"][0] = 7; });
  expect_change("category", [](json& r) { r["category_id"] = 2; });
  expect_change("keypoints", [](json& r) { r["keypoints"] = keypoints_at(-5, 3); });
  expect_change("keypoints", [](json& r) { r["keypoints"] = keypoints_at(161, 3); });
  expect_change("ids", [](json& r) { r["track_id"] = 5'000'001; });
  expect_change("ids", [](json& r) { r["track_id"] = 99; });
  expect_change("ids", [](json& r) { r["id"] = r["id"].get<std::int64_t>() + 7; });
}

TEST_F(Validate, PlacesThatTheImageDoesNotShow) {
  expect_change("keypoints", [](json& r) {
    for (json& place : r["keypoints_3d"]) place[0] = place[0].get<double>() + 0.3;
  });
  expect_change("truncation", [](json& r) { r["truncation"] = 0.7; });
  const std::string whole = read_file(root_ / formats::kCocoFile);
  change_image(
      [](json& r) { r["camera"]["K"][0][0] = 1.05 * r["camera"]["K"][0][0].get<double>(); });
  expect("keypoints", formats::kCocoFile, "annotation ");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_image([](json& r) { r["counts"]["truncated"] = 77; });
  expect("counts", formats::kCocoFile, "image 1");
}

TEST_F(Validate, ExportsThatWereTouched) {
  formats_ = {"voc", "mot", "webdataset", "shanghaitech", "coco", "table"};
  formats::export_dataset(info(), formats::choose_formats(formats_, annotations_, ""),
                          root_ / "formats");
  write_manifest();
  EXPECT_EQ(validate_dataset(root_).found, 0U);
  const auto touched = [&](const std::string& path, const std::string& from,
                           const std::string& to) {
    SCOPED_TRACE(path);
    const std::string whole = read_file(root_ / path);
    std::string text = whole;
    ASSERT_NE(text.find(from), std::string::npos);
    write(path, text.replace(text.find(from), from.size(), to));
    expect("formats", path, "");
    write(path, whole);
  };
  touched("formats/voc/Annotations/run000-d1-000000.xml", "<xmin>", "<xmin>1");
  touched("formats/mot/train/run000-d1/seqinfo.ini", "seqLength=3", "seqLength=4");
  touched("formats/coco/annotations/instances_train.json", "\"area\":", "\"area\":1");
  touched("formats/webdataset/train-000000.tar", "\"area\":", "\"aera\":");
  touched("formats/table/people.csv", "run000", "run009");
  fs::copy_file(root_ / "formats/voc/Annotations/run000-d1-000000.xml",
                root_ / "formats/voc/Annotations/leak.xml");
  write_manifest();
  expect("formats", "formats/voc/Annotations/leak.xml", "");
}

TEST_F(Validate, FilesThatAreMissingCutOffOrTooMany) {
  const fs::path image = root_ / "images/run000/d1/000001.jpg";
  fs::resize_file(image, 10);
  expect("manifest", "images/run000/d1/000001.jpg", "");
  write_manifest();
  expect("image", "images/run000/d1/000001.jpg", "image 2");
  fs::remove(image);
  expect("manifest", "images/run000/d1/000001.jpg", "");
  std::ofstream(root_ / "stranger.txt") << "x";
  expect("manifest", "stranger.txt", "");
}

TEST_F(Validate, BytesThatWereChanged) {
  const fs::path map = root_ / "density/run000/d2/000000.npz";
  const formats::FloatMap whole = formats::read_npy(map);
  annotate::DensityMap changed{whole.width, whole.height, whole.value};
  changed.value.back() = 8;
  write_file_atomically(map, annotate::npz_bytes(changed));
  expect("manifest", "density/run000/d2/000000.npz", "");
  write_manifest();
  expect("density-sum", "density/run000/d2/000000.npz", "");
}

TEST_F(Validate, ImagesOfInstancesThatAreNotTheMasks) {
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

TEST_F(Validate, ClassesThatAreNotThoseOfTheMasks) {
  const std::string path = "semantic/run000/d1/000000.png";
  annotations_.emplace_back("semantic");
  write_manifest();
  EXPECT_EQ(validate_dataset(root_).found, 0U);
  const images::Raster whole = images::read_raster(root_ / path);
  const auto damaged = [&](std::uint16_t from, std::uint8_t to) {
    SCOPED_TRACE(from);
    std::vector<std::uint8_t> classes(whole.samples.begin(), whole.samples.end());
    const auto found = std::find(classes.begin(), classes.end(), from);
    ASSERT_NE(found, classes.end());
    *found = to;
    write(path, annotate::png_bytes({whole.width, whole.height, 1}, classes));
    expect("semantic", path, "image 1");
  };
  damaged(4, 1);  // a person's pixel that is ground
  damaged(11, 4);
  damaged(11, 6);
  damaged(11, 34);  // no class
  damaged(13, 2);   // only the instances know
  damaged(5, 1);
  std::erase(annotations_, "instances");
  damaged(4, 1);  // the masks know without instances
}

TEST_F(Validate, KindsWhoseFilesAreMissing) {
  annotations_.emplace_back("semantic");
  fs::remove(root_ / "semantic/run001/d2/000002.png");
  write_manifest();
  expect("ground-truth", "semantic/run001/d2/000002.png", "image 12");
  std::erase(annotations_, "semantic");
  annotations_.emplace_back("exits");
  write_manifest();
  expect("ground-truth", "exits/run000.csv", "image 1");
}

// In the fixture nothing moves, but flow says so.
TEST_F(Validate, FlowThatLeadsElsewhere) {
  annotations_.emplace_back("flow");
  write_manifest();
  expect("flow-of-still", "flow/run000/d1/000000.png", "image 1");
  write_file_atomically(root_ / "flow/run000/d1/000001.png",
                        annotate::png_bytes({160, 120, 3}, std::vector<std::uint16_t>(57600, 7)));
  write_manifest();
  expect("flow", "flow/run000/d1/000001.png", "pixel 0");
}

TEST_F(Validate, RecordsThatAreNone) {
  const std::string whole = read_file(root_ / formats::kCocoFile);
  change_person([](json& r) { r.erase("position"); });
  expect("schema", formats::kCocoFile, "line ");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_person([](json& r) { r["segmentation"].erase("size"); });
  expect("schema", formats::kCocoFile, "");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_lines("\"image_id\":", [](std::string line) {
    const std::string key = "\"area\":";
    return line.replace(line.find(key), key.size() + 1, key + "NaN") + "\n";
  });
  expect("schema", formats::kCocoFile, "line ");
}

TEST_F(Validate, VisibleKeypointsAwayFromTheMask) {
  change_person([](json& r) {
    const auto x = r["bbox_amodal"][0].get<double>() > 80 ? 5.0 : 150.0;
    r["keypoints"] = keypoints_at(x, 60);
    r["bbox_amodal"] = {0, 0, 160, 120};
  });
  expect("keypoints", formats::kCocoFile, "annotation ");
}

TEST_F(Validate, IdsThatComeTwice) {
  const std::string whole = read_file(root_ / formats::kCocoFile);
  const auto twice = [](const std::string& line) { return line + "\n" + line + "\n"; };
  change_lines("\"image_id\":", twice);
  expect("ids", formats::kCocoFile, "annotation ");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_lines("\"file_name\":", twice);
  expect("ids", formats::kCocoFile, "image 1");
}

TEST_F(Validate, PeopleAndImagesThatAreLeftOut) {
  const std::string whole = read_file(root_ / formats::kCocoFile);
  change_lines("\"image_id\":", [](const std::string&) { return ""; });
  expect("counts", formats::kCocoFile, "image 1");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  json manifest = json::parse(read_file(root_ / "manifest.json"));
  manifest["counts"] = {{"frames", 13}, {"annotations", coco().at("annotations").size()}};
  write_file_atomically(root_ / "manifest.json", manifest.dump());
  expect("counts", formats::kCocoFile, "");
}

TEST_F(Validate, ImagesOfAnotherTick) {
  const std::string whole = read_file(root_ / formats::kCocoFile);
  change_image([](json& r) { r["time_s"] = 0.5; });
  expect("time", formats::kCocoFile, "image 1");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_image([](json& r) { r["file_name"] = "images/run000/d1/000001.jpg"; });
  expect("time", formats::kCocoFile, "image 1");
}

TEST_F(Validate, CamerasThatContradictThemselves) {
  const std::string whole = read_file(root_ / formats::kCocoFile);
  change_image([](json& r) { r["camera"]["t"][1] = r["camera"]["t"][1].get<double>() + 0.01; });
  expect("camera", formats::kCocoFile, "image 1");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_image([](json& r) { std::swap(r["camera"]["R"][0], r["camera"]["R"][1]); });
  expect("camera", formats::kCocoFile, "image 1");
}

TEST_F(Validate, WholeMasksThatLackVisiblePixels) {
  const std::string whole = read_file(root_ / formats::kCocoFile);
  // Nobody is set apart: the mask is empty, of the visible pixels, or of one more than there are.
  change_person([](json& r) {
    r["amodal_segmentation"] = r["segmentation"];
    r["amodal_segmentation"]["counts"] = formats::encode_counts({160 * 120});
  });
  expect("visible-in-amodal", formats::kCocoFile, "annotation ");
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_person([](json& r) {
    r["amodal_segmentation"] = r["segmentation"];
    r["area_amodal"] = r["area"];
    r["visibility"] = 1;
  });
  EXPECT_EQ(validate_dataset(root_).found, 0U);
  write_file_atomically(root_ / formats::kCocoFile, whole);
  change_person([](json& r) {
    r["amodal_segmentation"] = r["segmentation"];
    r["amodal_segmentation"]["counts"] = formats::encode_counts({0, 160 * 120});
  });
  expect("area-is-mask", formats::kCocoFile, "annotation ");
}

TEST_F(Validate, ImagesThatAreCutOff) {
  const fs::path image = root_ / "images/run000/d1/000001.jpg";
  fs::resize_file(image, fs::file_size(image) * 7 / 10);
  write_manifest();
  expect("image", "images/run000/d1/000001.jpg", "image 2");
}

TEST_F(Validate, ImagesThatWereExchanged) {
  const fs::path a = root_ / "images/run000/d1/000001.jpg";
  const fs::path b = root_ / "images/run000/d1/000002.jpg";
  const render::Frame other = annotate::empty_frame(160, 120);
  write("images/run000/d1/000001.jpg", images::jpeg_bytes(other.rgb, 160, 120, 50));
  fs::rename(a, folder_ / "aside");
  fs::rename(b, a);
  fs::rename(folder_ / "aside", b);
  expect("manifest", "images/run000/d1/000001.jpg", "");
}

TEST_F(Validate, DensityMapsThatAreNotTheHeads) {
  const std::string path = "density/run000/d2/000000.npz";
  const formats::FloatMap whole = formats::read_npy(root_ / path);
  const auto damaged = [&](const std::function<void(annotate::DensityMap&)>& damage) {
    annotate::DensityMap map{whole.width, whole.height, whole.value};
    damage(map);
    write(path, annotate::npz_bytes(map));
  };
  damaged([](auto& map) {
    for (float& value : map.value) value *= 1.01F;
  });
  expect("density-sum", path, "");
  damaged([](auto& map) { map.value[7] = std::numeric_limits<float>::quiet_NaN(); });
  expect("density-sum", path, "");
  damaged([](auto& map) { map.value[7] = -1e-4F; });
  expect("density-sum", path, "");
  damaged(
      [](auto& map) { std::rotate(map.value.begin(), map.value.begin() + 2, map.value.end()); });
  expect("density-is-heads", path, "image 4");
  damaged([](auto& map) { std::swap(map.width, map.height); });
  expect("density-size", path, "");
}

TEST_F(Validate, DepthThatIsScaled) {
  const std::string path = "depth/run000/d1/000000.png";
  images::Raster depth = images::read_raster(root_ / path);
  for (std::uint16_t& value : depth.samples) value = static_cast<std::uint16_t>(value * 1.01);
  write(path, annotate::png_bytes({depth.width, depth.height, 1}, depth.samples));
  expect("depth-of-ground", path, "image 1");
}

// As consistent as it can be made: mask, box, area and visibility.
TEST_F(Validate, MasksThatAreAPixelWider) {
  change_person([](json& r) {
    const formats::Bitmap mask = formats::decode_bitmap(
        formats::decode_runs(r["segmentation"]["counts"].get<std::string>(), 160 * 120), 120);
    formats::Bitmap wide = mask;
    wide.x = std::max(0, mask.x - 1);
    wide.width = std::min(160, mask.x + mask.width + 1) - wide.x;
    wide.set.clear();
    for (int y = mask.y; y < mask.y + mask.height; ++y) {
      for (int x = wide.x; x < wide.x + wide.width; ++x) {
        wide.set.push_back(mask.at(x - 1, y) || mask.at(x, y) || mask.at(x + 1, y) ? 1 : 0);
      }
    }
    r["segmentation"]["counts"] = formats::encode_counts(formats::union_runs({wide}, 160, 120));
    r["bbox"] = {wide.x, wide.y, wide.width, wide.height};
    r["bbox_amodal"] = {0, 0, 160, 120};
    r["area"] = wide.area();
    r["area_amodal"] = std::max<std::uint64_t>(wide.area(), r["area_amodal"].get<std::uint64_t>());
    r["visibility"] = static_cast<double>(wide.area()) / r["area_amodal"].get<double>();
  });
  expect("instances-are-masks", "instances/run000/d1/000000.png", "annotation ");
}

TEST_F(Validate, OtherFormatsThatSaySomethingElse) {
  using Damage = std::function<void(std::string&)>;
  const auto damaged = [&](const std::string& path, const Damage& damage) {
    SCOPED_TRACE(path);
    const std::string whole = read_file(root_ / "formats" / path);
    std::string text = whole;
    damage(text);
    write("formats/" + path, text);
    expect("formats", path, "");
    write("formats/" + path, whole);
  };
  const Damage next_digit = [](std::string& text) {
    char& digit = text[text.find(',') - 1];
    digit = digit == '9' ? '8' : static_cast<char>(digit + 1);
  };
  const std::string track = "mot/train/run000-d1/gt/gt.txt";
  with_format("mot");
  damaged(track, [](std::string& text) { text.insert(2, "9"); });
  damaged(track, [](std::string& text) { text.erase(0, text.find('\n') + 1); });
  damaged("mot/train/run001-d2/gt/gt.txt",
          [](std::string& text) { text += "3,77,1,1,5,5,1,1,1\n"; });
  with_format("visdrone-det");
  damaged("visdrone-det/train/annotations/run000-d1-000000.txt", next_digit);
  with_format("visdrone-mot");
  damaged("visdrone-mot/train/annotations/run001-d1.txt", next_digit);
  with_format("yolo-detect");
  damaged("yolo-detect/labels/train/run000-d1-000000.txt",
          [](std::string& text) { text.replace(4, 1, text[4] == '5' ? "6" : "5"); });
  with_format("yolo-pose");
  damaged("yolo-pose/labels/train/run000-d1-000000.txt",
          [](std::string& text) { text += text.substr(0, text.find('\n') + 1); });
}

TEST_F(Validate, AFolderThatIsNoDatasetIsRefused) {
  EXPECT_THROW(validate_dataset(folder_), InputError);
}

}  // namespace
}  // namespace throng::checks
