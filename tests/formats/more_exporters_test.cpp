// Exports of texts, points, values per pixel and containers, read back by readers of their own.
#include <archive.h>
#include <archive_entry.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <sstream>

#include "annotate/rasters/png.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/graphics/images/raster.h"
#include "formats/files/npy.h"
#include "tests/formats/dataset_fixture.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using MoreExports = SmallDataset;

template <typename Value>
Value value_at(const std::string& bytes, std::size_t at) {
  Value value;
  EXPECT_LE(at + sizeof(value), bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

// Heads inside the image, in box coordinates.
std::vector<std::pair<double, double>> heads_of_people(const std::vector<json>& people) {
  std::vector<std::pair<double, double>> heads;
  for (const json& person : people) {
    const json& head = person.at("head");
    if (head.is_null() || head[0] < 0 || head[1] < 0 || head[0] >= 160 || head[1] >= 120) continue;
    heads.emplace_back(head[0], head[1]);
  }
  return heads;
}

TEST_F(MoreExports, PointsAndDensityOfAllKernelsCountHeads) {
  for (const char* format : {"shanghaitech", "shanghaitech-adaptive", "shanghaitech-perspective"}) {
    const fs::path truth = exported(format) / "train_data/ground_truth";
    for (const auto& [stem, people] : people_by_stem(coco())) {
      const double count = static_cast<double>(heads_of_people(people).size());
      const FloatMap map = read_npy(truth / ("IMG_" + stem + ".npy"));
      EXPECT_NEAR(std::accumulate(map.value.begin(), map.value.end(), 0.0), count,
                  1e-3 * std::max(count, 1.0));
      const hid_t file =
          H5Fopen((truth / ("IMG_" + stem + ".h5")).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      const hid_t data = H5Dopen2(file, "density", H5P_DEFAULT);
      std::vector<float> values(map.value.size());
      EXPECT_GE(H5Dread(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
      H5Dclose(data);
      H5Fclose(file);
      EXPECT_EQ(values, map.value);
    }
  }
}

// Elements of a MATLAB 5 file: (type, begin, end) from `at` on.
struct Element {
  std::uint32_t type;
  std::size_t begin;
  std::size_t size;
};
std::vector<Element> read_elements(const std::string& bytes, std::size_t at, std::size_t end) {
  std::vector<Element> elements;
  while (at < end) {
    const auto size = value_at<std::uint32_t>(bytes, at + 4);
    elements.push_back({value_at<std::uint32_t>(bytes, at), at + 8, size});
    at += 8 + (size + 7) / 8 * 8;
  }
  return elements;
}

TEST_F(MoreExports, MatFilesHoldThePointsFromOne) {
  const fs::path truth = exported("shanghaitech") / "train_data/ground_truth";
  for (const auto& [stem, people] : people_by_stem(coco())) {
    const std::string bytes = read_file(truth / ("GT_IMG_" + stem + ".mat"));
    EXPECT_EQ(bytes.substr(0, 10), "MATLAB 5.0");
    EXPECT_EQ(bytes.substr(124, 4), std::string("\x00\x01IM", 4));
    const auto variables = read_elements(bytes, 128, bytes.size());
    ASSERT_EQ(variables.size(), 1U);
    const auto cell =
        read_elements(bytes, variables[0].begin, variables[0].begin + variables[0].size);
    ASSERT_EQ(cell.size(), 4U);
    EXPECT_EQ(bytes.substr(cell[2].begin, cell[2].size), "image_info");
    const auto inner = read_elements(bytes, cell[3].begin, cell[3].begin + cell[3].size);
    ASSERT_EQ(inner.size(), 7U);
    EXPECT_STREQ(bytes.c_str() + inner[4].begin, "location");
    const auto location = read_elements(bytes, inner[5].begin, inner[5].begin + inner[5].size);
    const auto heads = heads_of_people(people);
    ASSERT_EQ(location.at(3).size, heads.size() * 16);
    for (std::size_t i = 0; i < heads.size(); ++i) {
      EXPECT_NEAR(value_at<double>(bytes, location[3].begin + 8 * i), heads[i].first + 0.5, 1e-9);
      EXPECT_NEAR(value_at<double>(bytes, location[3].begin + 8 * (heads.size() + i)),
                  heads[i].second + 0.5, 1e-9);
    }
  }
}

TEST_F(MoreExports, KittiPutsPeopleWhereTheirBoxesAre) {
  ExportOptions options;
  options.filters.min_visibility = 0.5;
  const fs::path out = exported("kitti", options) / "train";
  int ignored = 0;
  for (const auto& [stem, people] : people_by_stem(coco())) {
    const auto lines = read_lines(out / "label_2" / (stem + ".txt"));
    ASSERT_EQ(lines.size(), people.size());
    const auto camera = parse_numbers(read_lines(out / "calib" / (stem + ".txt")).at(2).substr(3));
    ASSERT_EQ(camera.size(), 12U);
    const std::string transform = read_lines(out / "calib" / (stem + ".txt")).back();
    const auto to_camera = parse_numbers(transform.substr(transform.find(':') + 1));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string type = lines[i].substr(0, lines[i].find(' '));
      const auto line = parse_numbers(lines[i].substr(type.size()));
      ASSERT_EQ(line.size(), 14U);
      const json& box = people[i].at("bbox");
      EXPECT_NEAR(line[3], number(box[0]), 0.01);
      EXPECT_NEAR(line[6], number(box[1]) + number(box[3]), 0.01);
      ignored += type == "DontCare" ? 1 : 0;
      if (type == "DontCare") continue;
      EXPECT_EQ(type, "Pedestrian");
      EXPECT_NEAR(line[7], number(people[i].at("box_3d")[5]), 1e-3);
      // In the fixture the middle of the box is that of the amodal box.
      const double x = line[10] + to_camera[2] * line[7] / 2;
      const double z = line[12] + to_camera[10] * line[7] / 2;
      const json& amodal = people[i].at("bbox_amodal");
      EXPECT_NEAR((camera[0] * x + camera[2] * z) / z + 0.5,
                  number(amodal[0]) + number(amodal[2]) / 2, 0.2);
    }
  }
  EXPECT_GT(ignored, 3);
}

TEST_F(MoreExports, KittiHoldsTheLens) {
  const auto distort = [&](const json& lens) {
    std::string text = read_file(root_ / kCocoFile);
    const std::string pinhole = R"("model":"pinhole")";
    const std::string members = lens.dump();
    for (std::size_t at = text.find(pinhole); at != std::string::npos;
         at = text.find(pinhole, at + 1)) {
      text.replace(at, pinhole.size(), members.substr(1, members.size() - 2));
    }
    write_file_atomically(root_ / kCocoFile, text);
  };
  const auto last_line = [](const fs::path& out) {
    for (const auto& file : fs::directory_iterator(out / "train/calib")) {
      return read_lines(file.path()).back();
    }
    return std::string();
  };
  fs::path out = exported("kitti");
  EXPECT_THAT(last_line(out), ::testing::StartsWith("Tr_world_to_cam:"));
  EXPECT_FALSE(fs::exists(out / "README.txt"));
  // Readers look for each of these names; the scanner's axes are x ahead, y left, z up.
  for (const auto& file : fs::directory_iterator(out / "train/calib")) {
    const std::string text = read_file(file.path());
    for (const char* name : {"P0:", "P1:", "P2:", "P3:", "R0_rect:", "Tr_imu_to_velo: 1 0 0 0 "}) {
      EXPECT_THAT(text, ::testing::HasSubstr(name));
    }
    EXPECT_THAT(text, ::testing::HasSubstr("Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"));
  }
  fs::remove_all(out);
  distort({{"model", "brown_conrady"},
           {"distortion", {{"k1", -0.2}, {"k2", 0.03}, {"p1", 0.001}, {"p2", 0}, {"k3", 0.5}}}});
  out = exported("kitti");
  const std::string line = last_line(out);
  EXPECT_THAT(line, ::testing::StartsWith("D2_brown_conrady: "));
  EXPECT_THAT(parse_numbers(line.substr(line.find(' '))),
              ::testing::ElementsAre(-0.2, 0.03, 0.001, 0, 0.5, 0, 0, 0));
  EXPECT_THAT(read_file(out / "README.txt"), ::testing::HasSubstr("distorted"));
}

TEST_F(MoreExports, VocCountsFromOneWithBothEndsInside) {
  const fs::path out = exported("voc");
  const auto people = people_by_stem(coco());
  EXPECT_EQ(read_lines(out / "ImageSets/Main/train.txt").size(), people.size());
  for (const auto& [stem, expected] : people) {
    tinyxml2::XMLDocument xml;
    ASSERT_EQ(xml.LoadFile((out / "Annotations" / (stem + ".xml")).c_str()), tinyxml2::XML_SUCCESS);
    std::size_t i = 0;
    for (const auto* object = xml.RootElement()->FirstChildElement("object"); object != nullptr;
         object = object->NextSiblingElement("object"), ++i) {
      const auto* box = object->FirstChildElement("bndbox");
      const json& bbox = expected.at(i).at("bbox");
      const auto at = [&](const char* key) { return box->FirstChildElement(key)->DoubleText(); };
      EXPECT_GT(at("xmax"), at("xmin"));
      EXPECT_GT(at("ymax"), at("ymin"));
      if (number(bbox[2]) > 1) {  // single pixels: HandMadeVoc
        EXPECT_EQ(at("xmin"), number(bbox[0]) + 1);
        EXPECT_EQ(at("xmax"), number(bbox[0]) + number(bbox[2]));
      }
      if (number(bbox[3]) > 1) {
        EXPECT_EQ(at("ymin"), number(bbox[1]) + 1);
        EXPECT_EQ(at("ymax"), number(bbox[1]) + number(bbox[3]));
      }
    }
    EXPECT_EQ(i, expected.size());
  }
}

TEST_F(MoreExports, CvatListsEveryImageAndBox) {
  const fs::path out = exported("cvat");
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.LoadFile((out / "annotations.xml").c_str()), tinyxml2::XML_SUCCESS);
  std::size_t images = 0;
  std::size_t boxes = 0;
  const auto people = people_by_stem(coco());
  for (const auto* image = xml.RootElement()->FirstChildElement("image"); image != nullptr;
       image = image->NextSiblingElement("image"), ++images) {
    const fs::path name = image->Attribute("name");
    EXPECT_TRUE(fs::exists(out / "images" / name));
    std::size_t i = 0;
    for (const auto* box = image->FirstChildElement("box"); box != nullptr;
         box = box->NextSiblingElement("box"), ++i, ++boxes) {
      const json& bbox = people.at(name.stem()).at(i).at("bbox");
      EXPECT_EQ(box->DoubleAttribute("xtl"), number(bbox[0]));
      EXPECT_EQ(box->DoubleAttribute("ybr"), number(bbox[1]) + number(bbox[3]));
    }
  }
  EXPECT_EQ(images, 12U);
  EXPECT_EQ(boxes, coco().at("annotations").size());
}

// A track of CVAT as its player shows it: the boxes by frame, from keyframe to keyframe.
std::map<int, const tinyxml2::XMLElement*> shown_boxes(const tinyxml2::XMLElement& track,
                                                       int frames) {
  std::map<int, const tinyxml2::XMLElement*> boxes;
  const tinyxml2::XMLElement* now = nullptr;
  for (int frame = 0; frame < frames; ++frame) {
    for (const auto* box = track.FirstChildElement("box"); box != nullptr;
         box = box->NextSiblingElement("box")) {
      if (box->IntAttribute("frame") == frame) now = box;
    }
    if (now != nullptr && now->IntAttribute("outside") == 0) boxes[frame] = now;
  }
  return boxes;
}

TEST_F(MoreExports, CvatVideosShowEachPersonWhereTheyAreAndNowhereElse) {
  const fs::path out = exported("cvat-video") / "train";
  const auto people = people_by_stem(coco());
  std::size_t boxes = 0;
  std::size_t tasks = 0;
  for (const auto& task : fs::directory_iterator(out)) {
    ++tasks;
    tinyxml2::XMLDocument xml;
    ASSERT_EQ(xml.LoadFile((task.path() / "annotations.xml").c_str()), tinyxml2::XML_SUCCESS);
    const int frames = xml.RootElement()
                           ->FirstChildElement("meta")
                           ->FirstChildElement("task")
                           ->FirstChildElement("size")
                           ->IntText();
    EXPECT_EQ(frames, kFrames);
    for (int frame = 0; frame < frames; ++frame) {
      EXPECT_TRUE(fs::exists(task.path() / fmt::format("images/frame_{:06}.jpg", frame)));
    }
    for (const auto* track = xml.RootElement()->FirstChildElement("track"); track != nullptr;
         track = track->NextSiblingElement("track")) {
      for (const auto& [frame, box] : shown_boxes(*track, frames)) {
        ++boxes;
        const std::string stem = fmt::format("{}-{:06}", task.path().filename().string(), frame);
        const auto& present = people.at(stem);
        const auto person = std::find_if(present.begin(), present.end(), [&](const json& one) {
          return one.at("track_id") == track->Int64Attribute("id");
        });
        ASSERT_NE(person, present.end()) << stem;
        EXPECT_EQ(box->DoubleAttribute("xtl"), number(person->at("bbox")[0]));
        EXPECT_EQ(box->DoubleAttribute("ytl"), number(person->at("bbox")[1]));
      }
    }
  }
  EXPECT_EQ(tasks, 4U);
  EXPECT_EQ(boxes, coco().at("annotations").size());
}

TEST_F(MoreExports, LabelStudioTasksHoldEveryBoxInPercent) {
  const fs::path out = exported("label-studio");
  const json tasks = json::parse(read_file(out / "tasks.json"));
  ASSERT_EQ(tasks.size(), 12U);
  const auto people = people_by_stem(coco());
  std::size_t boxes = 0;
  for (const json& task : tasks) {
    const std::string address = task.at("data").at("image");
    const std::string root = "/data/local-files/?d=";
    ASSERT_TRUE(address.starts_with(root));
    const fs::path image = address.substr(root.size());
    EXPECT_TRUE(fs::exists(out / image));
    const json& result = task.at("annotations").at(0).at("result");
    const auto& expected = people.at(image.stem());
    ASSERT_EQ(result.size(), expected.size());
    for (std::size_t i = 0; i < result.size(); ++i, ++boxes) {
      const json& value = result[i].at("value");
      EXPECT_NEAR(number(value.at("x")) / 100 * number(result[i].at("original_width")),
                  number(expected[i].at("bbox")[0]), 1e-9);
      EXPECT_NEAR(number(value.at("height")) / 100 * number(result[i].at("original_height")),
                  number(expected[i].at("bbox")[3]), 1e-9);
    }
  }
  EXPECT_EQ(boxes, coco().at("annotations").size());
  tinyxml2::XMLDocument config;
  ASSERT_EQ(config.LoadFile((out / "config.xml").c_str()), tinyxml2::XML_SUCCESS);
  EXPECT_STREQ(config.RootElement()->FirstChildElement("RectangleLabels")->Attribute("toName"),
               "image");
}

TEST_F(MoreExports, FiftyOneHasRelativeBoxesPerSplit) {
  ExportOptions options;
  options.splits.runs = {{"run001", Split::val}};
  const fs::path out = exported("fiftyone", options);
  const auto people = people_by_stem(coco());
  std::size_t boxes = 0;
  for (const char* split : {"train", "val"}) {
    const json labels = json::parse(read_file(out / split / "labels.json"));
    EXPECT_EQ(labels.at("classes").at(0), "person");
    for (const auto& [stem, detections] : labels.at("labels").items()) {
      EXPECT_TRUE(fs::exists(out / split / "data" / (stem + ".jpg")));
      for (std::size_t i = 0; i < detections.size(); ++i, ++boxes) {
        const json& box = detections[i].at("bounding_box");
        EXPECT_NEAR(160 * number(box[0]), number(people.at(stem).at(i).at("bbox")[0]), 1e-9);
        EXPECT_NEAR(120 * number(box[3]), number(people.at(stem).at(i).at("bbox")[3]), 1e-9);
      }
    }
  }
  EXPECT_EQ(boxes, coco().at("annotations").size());
}

TEST_F(MoreExports, ImageFoldersLinesHaveEqualKeys) {
  ExportOptions options;
  options.splits.runs = {{"run001", Split::val}};
  const fs::path out = exported("imagefolder", options);
  std::size_t boxes = 0;
  for (const char* split : {"train", "validation"}) {
    std::vector<std::string> keys;
    for (const std::string& text : read_lines(out / split / "metadata.jsonl")) {
      const json line = json::parse(text);
      std::vector<std::string> own;
      for (const auto& [key, value] : line.items()) own.push_back(key);
      EXPECT_TRUE(keys.empty() || keys == own);
      keys = own;
      EXPECT_TRUE(fs::exists(out / split / line.at("file_name").get<std::string>()));
      boxes += line.at("objects").at("bbox").size();
    }
    EXPECT_FALSE(keys.empty());
  }
  EXPECT_EQ(boxes, coco().at("annotations").size());
  const std::string card = read_file(out / "README.md");
  EXPECT_TRUE(card.starts_with("---\nlicense: cc0-1.0\n")) << card;
  EXPECT_THAT(card, ::testing::HasSubstr("size_categories:\n- n<1K\n---\n"));
  EXPECT_THAT(card, ::testing::HasSubstr("| 0 | person |"));
}

TEST_F(MoreExports, WebDatasetKeepsSamplesTogether) {
  const fs::path tar = exported("webdataset") / "train-000000.tar";
  archive* reader = archive_read_new();
  archive_read_support_format_tar(reader);
  ASSERT_EQ(archive_read_open_filename(reader, tar.c_str(), 10240), ARCHIVE_OK);
  archive_entry* entry = nullptr;
  std::vector<std::string> names;
  std::size_t annotations = 0;
  while (archive_read_next_header(reader, &entry) == ARCHIVE_OK) {
    names.emplace_back(archive_entry_pathname(entry));
    EXPECT_EQ(archive_entry_mtime(entry), 0);
    std::string bytes(static_cast<std::size_t>(archive_entry_size(entry)), '\0');
    EXPECT_EQ(archive_read_data(reader, bytes.data(), bytes.size()),
              static_cast<la_ssize_t>(bytes.size()));
    if (!names.back().ends_with(".json")) continue;
    annotations += json::parse(bytes).at("annotations").size();
  }
  archive_read_free(reader);
  ASSERT_EQ(names.size(), 24U);
  for (std::size_t i = 0; i < names.size(); i += 2) {
    const std::string key = names[i].substr(0, names[i].find('.'));
    EXPECT_EQ(names[i], key + ".jpg");
    EXPECT_EQ(names[i + 1], key + ".json");
  }
  EXPECT_EQ(annotations, coco().at("annotations").size());
}

TEST_F(MoreExports, WebDatasetRefusesSamplesThatAreOneFileElsewhere) {
  const fs::path labels = folder_ / "dataset" / "annotations" / "instances.json";
  std::string text = read_file(labels);
  for (std::size_t at = 0; (at = text.find("\"d2\"", at)) != std::string::npos;) {
    text.replace(at, 4, "\"D1\"");
  }
  write_file_atomically(labels, text);
  try {
    exported("webdataset");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("one file on Windows and macOS"));
  }
}

TEST_F(MoreExports, WebDatasetBeginsAShardWhereTheLastIsFull) {
  ExportOptions options;
  options.webdataset.shard_mb = 0.01;
  const fs::path folder = exported("webdataset", options);
  const json shards = json::parse(read_file(folder / "shards.json")).at("train");
  ASSERT_GT(shards.size(), 1U);
  std::int64_t samples = 0;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    const fs::path tar = folder / shards[i].at("file").get<std::string>();
    EXPECT_EQ(tar.filename(), fmt::format("train-{:06}.tar", i));
    EXPECT_EQ(shards[i].at("bytes"), fs::file_size(tar));
    EXPECT_EQ(shards[i].at("sha256"), sha256_hex(read_file(tar)));
    samples += shards[i].at("samples").get<std::int64_t>();
    // A sample is never cut, so one that is too large has a shard of its own; the end of a tar
    // file fills a block.
    if (shards[i].at("samples") > 1) {
      EXPECT_LE(fs::file_size(tar), 10'000 + 10'240);
    }
  }
  EXPECT_EQ(samples, 12);
}

TEST_F(MoreExports, FloHasBackwardFlowAndOcclusionIfTheDatasetHas) {
  for (const char* kind : {"flow", "flow_backward", "flow_occlusion"})
    annotations_.emplace_back(kind);
  write_manifest();
  for (const auto& entry : fs::recursive_directory_iterator(root_ / "flow")) {
    if (!entry.is_regular_file()) continue;
    const fs::path inner = fs::relative(entry.path(), root_ / "flow");
    write_file_atomically(root_ / "flow_backward" / inner, read_file(entry.path()));
    std::vector<std::uint8_t> targets(160 * 120, 1);
    targets[500] = 2;
    targets[501] = 3;
    write_file_atomically(
        root_ / "flow_occlusion" / inner,
        annotate::png_bytes({160, 120, 1}, std::span<const std::uint8_t>(targets)));
  }
  const fs::path stem = exported("flow-flo") / "run000-d1/run000-d1-000001";
  EXPECT_EQ(read_file(stem.string() + ".backward.flo"), read_file(stem.string() + ".flo"));
  const images::Raster mask = images::read_raster(stem.string() + ".occlusion.png");
  for (std::size_t i = 0; i < mask.samples.size(); ++i) {
    ASSERT_EQ(mask.samples[i], i == 500 || i == 501 ? 255 : 0) << i;
  }
}

TEST_F(MoreExports, FloAndExrAreTheValuesPerPixel) {
  annotations_.emplace_back("flow");
  write_manifest();
  const std::string flo = read_file(exported("flow-flo") / "run000-d1/run000-d1-000001.flo");
  ASSERT_EQ(flo.size(), 12U + 8 * 160 * 120);
  EXPECT_EQ(flo.substr(0, 4), "PIEH");
  EXPECT_EQ(value_at<std::int32_t>(flo, 4), 160);
  EXPECT_EQ(value_at<float>(flo, 12 + 8 * 500), 1.5F);
  const std::string exr = read_file(exported("depth-exr") / "run000-d1/run000-d1-000001.exr");
  EXPECT_EQ(value_at<std::uint32_t>(exr, 0), 20000630U);  // hand_made_files_test reads one
  EXPECT_LT(exr.size(), 4U * 160 * 120) << "compressed";
}

TEST_F(MoreExports, TheTableHasALineForEachAnnotation) {
  const auto lines = read_lines(exported("table") / "people.csv");
  const json all = coco();
  ASSERT_EQ(lines.size(), 1 + all.at("annotations").size());
  const auto columns = std::count(lines[0].begin(), lines[0].end(), ',');
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns);
  }
  EXPECT_THAT(lines[1], ::testing::HasSubstr("," + all.at("annotations")[0].at("id").dump() + ","));
}

// Their content is read by @mcap/core: tests/cli/test_recordings.py.
TEST_F(MoreExports, RecordingsAreTheSameEveryTime) {
  const std::string recording = read_file(exported("mcap") / "train/run001.mcap");
  EXPECT_TRUE(recording.starts_with("\x89MCAP0\r\n"));
  EXPECT_EQ(read_file(exported("mcap") / "train/run001.mcap"), recording);
}

TEST_F(MoreExports, RecordingsRefuseDronesThatRosCannotTellApart) {
  std::string text = read_file(root_ / kCocoFile);
  for (const auto& [from, to] : {std::pair{R"("d1")", R"("d-1")"}, {R"("d2")", R"("d_1")"}}) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
      text.replace(at, 4, to);
    }
  }
  write_file_atomically(root_ / kCocoFile, text);
  EXPECT_THROW(exported("mcap"), InputError);
}

TEST_F(MoreExports, DroneCrowdBoxesAreAboutHeads) {
  const fs::path out = exported("dronecrowd") / "train";
  std::size_t heads = 0;
  std::size_t expected = 0;
  for (const auto& [stem, people] : people_by_stem(coco()))
    expected += heads_of_people(people).size();
  for (const char* sequence : {"run000-d1", "run000-d2", "run001-d1", "run001-d2"}) {
    for (const std::string& line :
         read_lines(out / "annotations" / (std::string(sequence) + ".txt"))) {
      const auto numbers = parse_numbers(line);
      ASSERT_EQ(numbers.size(), 10U);
      EXPECT_GE(numbers[4], 1);
      ++heads;
    }
  }
  EXPECT_EQ(heads, expected);
}

}  // namespace
}  // namespace throng::formats
