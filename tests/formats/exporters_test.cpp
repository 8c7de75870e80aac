// Every export is read back by a reader of its own and compared with the dataset's COCO file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/graphics/images/raster.h"
#include "formats/dataset/mask.h"
#include "tests/annotate/rle.h"
#include "tests/formats/dataset_fixture.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Exports = SmallDataset;

TEST_F(Exports, YoloBoxesAreTheVisibleOnes) {
  const fs::path out = exported("yolo-detect");
  std::size_t count = 0;
  for (const auto& [stem, people] : people_by_stem(coco())) {
    EXPECT_TRUE(fs::exists(out / "images/train" / (stem + ".jpg")));
    const auto lines = read_lines(out / "labels/train" / (stem + ".txt"));
    ASSERT_EQ(lines.size(), people.size());
    for (std::size_t i = 0; i < lines.size(); ++i, ++count) {
      const std::vector<double> line = parse_numbers(lines[i]);
      ASSERT_EQ(line.size(), 5U);
      const json& box = people[i].at("bbox");
      EXPECT_EQ(line[0], 0);
      EXPECT_NEAR((line[1] - line[3] / 2) * 160, number(box[0]), 1e-3);
      EXPECT_NEAR((line[2] - line[4] / 2) * 120, number(box[1]), 1e-3);
      EXPECT_NEAR(line[3] * 160, number(box[2]), 1e-3);
      EXPECT_NEAR(line[4] * 120, number(box[3]), 1e-3);
    }
  }
  EXPECT_GT(count, 60U);
  EXPECT_THAT(read_file(out / "data.yaml"), ::testing::HasSubstr("  0: \"person\""));
}

TEST_F(Exports, YoloPosesAreTheKeypoints) {
  const fs::path out = exported("yolo-pose");
  EXPECT_THAT(read_file(out / "data.yaml"), ::testing::HasSubstr("kpt_shape: [17, 3]"));
  for (const auto& [stem, people] : people_by_stem(coco())) {
    const auto lines = read_lines(out / "labels/train" / (stem + ".txt"));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::vector<double> line = parse_numbers(lines[i]);
      ASSERT_EQ(line.size(), 5U + 51);
      const json& keypoints = people[i].at("keypoints");
      for (std::size_t k = 0; k < 17; ++k) {
        EXPECT_NEAR(line[5 + 3 * k] * 160, number(keypoints[3 * k]), 1e-3);
        EXPECT_NEAR(line[6 + 3 * k] * 120, number(keypoints[3 * k + 1]), 1e-3);
        EXPECT_EQ(line[7 + 3 * k], number(keypoints[3 * k + 2]));
      }
    }
  }
}

TEST_F(Exports, MotCountsFromOneAndHasWholeBodies) {
  ExportOptions options;
  options.filters.min_visibility = 0.5;
  const fs::path out = exported("mot", options) / "train";
  const json all = coco();
  const auto images = images_by_id(all);
  std::map<std::string, std::vector<std::vector<double>>> rows;
  for (const json& person : all.at("annotations")) {
    const json& image = images.at(person.at("image_id"));
    const json& box = person.at("bbox_amodal");
    const double visibility = number(person.at("visibility"));
    rows[image.at("run").get<std::string>() + "-" + image.at("camera_id").get<std::string>()]
        .push_back({number(image.at("frame")) + 1, std::fmod(number(person.at("track_id")), 1e6),
                    number(box[0]) + 1, number(box[1]) + 1, number(box[2]), number(box[3]),
                    visibility < 0.5 ? 0.0 : 1, 1, visibility});
  }
  ASSERT_EQ(rows.size(), 4U);
  // Those of whom nothing is visible stand after the others of their frame.
  for (const json& image : all.at("images")) {
    auto& of =
        rows[image.at("run").get<std::string>() + "-" + image.at("camera_id").get<std::string>()];
    for (const json& person : image.value("hidden", json::array())) {
      const json& box = person.at("bbox_amodal");
      of.push_back({number(image.at("frame")) + 1, std::fmod(number(person.at("track_id")), 1e6),
                    number(box[0]) + 1, number(box[1]) + 1, number(box[2]), number(box[3]), 0, 1,
                    0});
    }
    std::stable_sort(of.begin(), of.end(),
                     [](const auto& a, const auto& b) { return a[0] < b[0]; });
  }
  int ignored = 0;
  int hidden = 0;
  for (const auto& [sequence, expected] : rows) {
    const auto lines = read_lines(out / sequence / "gt/gt.txt");
    ASSERT_EQ(lines.size(), expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_THAT(parse_numbers(lines[i]),
                  ::testing::Pointwise(::testing::DoubleNear(1e-4), expected[i]));
      ignored += expected[i][6] == 0 ? 1 : 0;
      hidden += expected[i][8] == 0 ? 1 : 0;
    }
    for (const char* name : {"000001", "000002", "000003"}) {
      EXPECT_TRUE(fs::exists(out / sequence / "img1" / (std::string(name) + ".jpg")));
    }
    EXPECT_EQ(read_file(out / sequence / "seqinfo.ini"),
              "[Sequence]\nname=" + sequence +
                  "\nimDir=img1\nframeRate=2\nseqLength=3\nimWidth=160\nimHeight=120\n"
                  "imExt=.jpg\n");
  }
  EXPECT_GT(ignored, 3);
  EXPECT_GT(hidden, 0);
}

TEST_F(Exports, MotDetectionsAreVisiblePeople) {
  const fs::path out = exported("mot") / "train";
  std::map<std::string, std::size_t> lines;
  for (const auto& [stem, people] : people_by_stem(coco())) {
    lines[stem.substr(0, stem.rfind('-'))] += people.size();
  }
  for (const auto& [sequence, expected] : lines) {
    const auto detections = read_lines(out / sequence / "det/det.txt");
    ASSERT_EQ(detections.size(), expected);
    for (const std::string& line : detections) {
      const auto numbers = parse_numbers(line);
      ASSERT_EQ(numbers.size(), 10U);
      EXPECT_EQ(numbers[1], -1);
      EXPECT_GE(numbers[2], 1);
      EXPECT_LE(numbers[2] + numbers[4], 161);
      EXPECT_GT(numbers[6], 0);
    }
  }
}

TEST_F(Exports, MotsMasksDoNotOverlapAndAreTheDatasets) {
  ExportOptions options;
  options.filters.min_visibility = 0.5;
  const fs::path out = exported("mots", options) / "train";
  std::map<std::pair<std::string, int>, std::vector<int>> painted;
  std::map<std::pair<std::string, int>, std::vector<std::uint16_t>> ids_of_pixels;
  int regions = 0;
  for (const char* sequence : {"run000-d1", "run000-d2", "run001-d1", "run001-d2"}) {
    for (const std::string& line : read_lines(out / sequence / "gt/gt.txt")) {
      std::istringstream text(line);
      int frame = 0;
      int id = 0;
      int category = 0;
      int height = 0;
      int width = 0;
      std::string counts;
      text >> frame >> id >> category >> height >> width >> counts;
      EXPECT_EQ(id == 10000, category == 10);
      EXPECT_TRUE(category == 10 || id / 1000 == 2);
      regions += category == 10 ? 1 : 0;
      const auto mask = annotate::mask_of_runs(annotate::runs_of_counts(counts), width, height);
      auto& pixels = painted[{sequence, frame}];
      pixels.resize(mask.size());
      auto& ids = ids_of_pixels[{sequence, frame}];
      ids.resize(mask.size());
      for (std::size_t i = 0; i < mask.size(); ++i) {
        pixels[i] += mask[i] ? 1 : 0;
        if (mask[i]) ids[i] = static_cast<std::uint16_t>(id);
      }
    }
  }
  EXPECT_GT(regions, 3);
  EXPECT_LE(regions, 12) << "at most one ignore region a frame";
  double area = 0;
  for (const auto& [key, pixels] : painted) {
    EXPECT_LE(*std::max_element(pixels.begin(), pixels.end()), 1);
    area += static_cast<double>(std::count(pixels.begin(), pixels.end(), 1));
  }
  for (const auto& [key, ids] : ids_of_pixels) {
    char name[16];
    std::snprintf(name, sizeof(name), "%06d.png", key.second);
    const images::Raster raster = images::read_raster(out / key.first / "instances" / name);
    ASSERT_EQ(raster.bits, 16);
    ASSERT_EQ(raster.channels, 1);
    EXPECT_EQ(raster.samples, ids) << key.first << " " << name;
  }
  double expected = 0;
  const json all = coco();
  for (const json& person : all.at("annotations")) expected += number(person.at("area"));
  EXPECT_EQ(area, expected);
}

TEST_F(Exports, VisDroneHasWholeNumbersAndClasses) {
  ExportOptions options;
  options.filters.min_height_px = 12;
  const fs::path det = exported("visdrone-det", options) / "train";
  for (const auto& [stem, people] : people_by_stem(coco())) {
    const auto lines = read_lines(det / "annotations" / (stem + ".txt"));
    ASSERT_EQ(lines.size(), people.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_EQ(lines[i].find('.'), std::string::npos);
      const json& person = people[i];
      const double visibility = number(person.at("visibility"));
      const bool kept = number(person.at("bbox_amodal")[3]) >= 12;
      const double hidden = visibility > 0.995 ? 0 : visibility >= 0.5 ? 1 : 2;
      const json& box = person.at("bbox");
      EXPECT_THAT(parse_numbers(lines[i]),
                  ::testing::ElementsAre(number(box[0]), number(box[1]), number(box[2]),
                                         number(box[3]), kept, kept,
                                         person.value("truncation", 0.0) < 0.005 ? 0 : 1, hidden));
    }
  }
  const fs::path mot = exported("visdrone-mot", options) / "train";
  EXPECT_TRUE(fs::exists(mot / "sequences/run001-d2/0000003.jpg"));
  const auto first = parse_numbers(read_lines(mot / "annotations/run001-d1.txt").at(0));
  ASSERT_EQ(first.size(), 10U);
  EXPECT_EQ(first[0], 1);
}

TEST_F(Exports, UavdtHasClassesOfItsOwn) {
  ExportOptions options;
  options.filters.min_visibility = 0.2;
  const fs::path out = exported("uavdt", options) / "train";
  EXPECT_TRUE(fs::exists(out / "UAV-benchmark-M/run001-d2/img000003.jpg"));
  std::map<std::string, std::vector<json>> people;
  std::map<std::string, std::size_t> ignored;
  for (const auto& [stem, in_image] : people_by_stem(coco())) {
    const std::string sequence = stem.substr(0, stem.rfind('-'));
    for (const json& person : in_image) {
      if (number(person.at("visibility")) < 0.2) {
        ++ignored[sequence];
      } else {
        people[sequence].push_back(person);
      }
    }
  }
  for (const auto& [sequence, expected] : people) {
    EXPECT_EQ(read_lines(out / "GT" / (sequence + "_gt_ignore.txt")).size(), ignored[sequence]);
    const auto lines = read_lines(out / "GT" / (sequence + "_gt_whole.txt"));
    ASSERT_EQ(lines.size(), expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto line = parse_numbers(lines[i]);
      ASSERT_EQ(line.size(), 9U);
      const double visibility = number(expected[i].at("visibility"));
      EXPECT_EQ(line[2], number(expected[i].at("bbox")[0]));
      EXPECT_EQ(line[7], visibility > 0.995  ? 1
                         : visibility >= 0.7 ? 4
                         : visibility >= 0.3 ? 3
                                             : 2);
    }
  }
}

TEST_F(Exports, CocoSplitsByRunAndHasIgnoreRegions) {
  ExportOptions options;
  options.splits.share = {0.5, 0.5, 0};
  options.filters.min_visibility = 0.5;
  const fs::path out = exported("coco", options);
  const json whole = coco();
  std::size_t annotations = 0;
  for (const auto& [split, run] : {std::pair{"train", "run000"}, {"val", "run001"}}) {
    const json part =
        json::parse(read_file(out / "annotations" / (std::string("instances_") + split + ".json")));
    EXPECT_EQ(part.at("images").size(), 6U);
    for (const json& image : part.at("images")) {
      EXPECT_EQ(image.at("run"), run);
      EXPECT_TRUE(fs::exists(out / split / image.at("file_name").get<std::string>()));
    }
    for (const json& person : part.at("annotations")) {
      const bool is_crowd = number(person.at("visibility")) < 0.5;
      EXPECT_EQ(person.at("iscrowd"), is_crowd ? 1 : 0);
      const json& counts = person.at("segmentation").at("counts");
      EXPECT_EQ(counts.is_array(), is_crowd);
      EXPECT_FALSE(person.contains("keypoints"));
      if (!is_crowd) continue;
      const auto mask = annotate::mask_of_runs(counts.get<std::vector<std::int64_t>>(), 160, 120);
      EXPECT_EQ(std::count(mask.begin(), mask.end(), true), person.at("area"));
    }
    annotations += part.at("annotations").size();
  }
  EXPECT_EQ(annotations, whole.at("annotations").size());
  EXPECT_FALSE(fs::exists(out / "annotations/instances_test.json"));
}

TEST_F(Exports, SplitsKeepRunsTogether) {
  ExportOptions options;
  options.splits.runs = {{"run000", Split::test}};
  const DatasetInfo described = info(options);
  EXPECT_EQ(described.split_of("run000"), Split::test);
  EXPECT_EQ(described.split_of("run001"), Split::train);
  EXPECT_THAT(described.splits(), ::testing::ElementsAre(Split::train, Split::test));
  options.splits.runs = {{"run009", Split::test}};  // failed
  EXPECT_THAT(info(options).splits(), ::testing::ElementsAre(Split::train));
}

TEST_F(Exports, YoloNamesOnlySplitsThatHaveImages) {
  ExportOptions options;
  for (const std::string format : {"yolo-detect", "yolo-segment", "yolo-pose"}) {
    const std::string yaml = read_file(exported(format, options) / "data.yaml");
    EXPECT_THAT(yaml, ::testing::HasSubstr("train: images/train\n"));
    EXPECT_THAT(yaml, ::testing::Not(::testing::HasSubstr("val:")));
    EXPECT_THAT(yaml, ::testing::Not(::testing::HasSubstr("test:")));
    const auto warnings = split_warnings(info(options), {find_format(format), find_format("mot")});
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0].text(), ::testing::HasSubstr(format + "/data.yaml"));
    EXPECT_THAT(warnings[0].text(), ::testing::HasSubstr("val"));
  }
  options.splits.runs = {{"run000", Split::test}, {"run001", Split::val}};
  const std::string yaml = read_file(exported("yolo-detect", options) / "data.yaml");
  EXPECT_THAT(yaml, ::testing::Not(::testing::HasSubstr("train:")));
  EXPECT_THAT(yaml, ::testing::HasSubstr("val: images/val\ntest: images/test\n"));
  options.splits.runs = {{"run001", Split::val}};
  EXPECT_TRUE(split_warnings(info(options), {find_format("yolo-pose")}).empty());
}

TEST(Splits, SharesAreAtMostEverything) {
  const auto settled = [](std::array<double, 3> share, bool has_train,
                          std::vector<Problem>& problems) {
    SplitOptions splits;
    splits.share = share;
    settle_shares(has_train, "/outputs/splits", splits, problems);
    return splits.share;
  };
  std::vector<Problem> problems;
  EXPECT_THAT(settled({0.7, 0.2, 0.1}, true, problems), ::testing::ElementsAre(0.7, 0.2, 0.1));
  EXPECT_THAT(settled({1, 0.2, 0.1}, false, problems),
              ::testing::ElementsAre(::testing::DoubleEq(0.7), 0.2, 0.1))
      << "train gets what the others leave";
  EXPECT_THAT(settled({1, 1, 0}, false, problems), ::testing::ElementsAre(0, 1, 0));
  EXPECT_TRUE(problems.empty());
  settled({1, 0.2, 0}, true, problems);
  settled({1, 0.7, 0.4}, false, problems);
  settled({0, 0, 0}, true, problems);
  ASSERT_EQ(problems.size(), 3U);
  for (const Problem& problem : problems) EXPECT_EQ(problem.where, "/outputs/splits");
  EXPECT_THAT(problems[0].found, ::testing::HasSubstr("1.2"));
  EXPECT_THAT(problems[1].found, ::testing::HasSubstr("1.1"));
}

// Records have a truncation where it is above 0.
TEST_F(Exports, TruncatedPeopleAreIgnored) {
  const auto ignored = [&](std::optional<double> max_truncation) {
    ExportOptions options;
    options.filters.max_truncation = max_truncation;
    const DatasetInfo described = info(options);
    DatasetReader reader(described);
    int count = 0;
    for (Image image; reader.next(image);) {
      for (const Person& person : image.people) {
        const bool is_beyond =
            max_truncation && person.record.value("truncation", 0.0) > *max_truncation;
        EXPECT_EQ(person.is_ignored, is_beyond);
        count += person.is_ignored ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(ignored(std::nullopt), 0);
  EXPECT_EQ(ignored(1), 0);
  EXPECT_GT(ignored(0), 0);
}

// Either contrast makes somebody distinct.
TEST_F(Exports, PeopleWithoutContrastAreIgnored) {
  std::string coco = read_file(root_ / kCocoFile);
  const std::string before = R"("iscrowd":0,)";
  const std::string added =
      R"("difficulty":{"contrast":1,"edge_contrast":2.5,"blur_px":0,"visible_keypoints":3},)";
  for (std::size_t at = coco.find(before); at != std::string::npos; at = coco.find(before, at)) {
    at += before.size();
    coco.insert(at, added);
  }
  write_file_atomically(root_ / kCocoFile, coco);
  const auto ignored = [&](double min_contrast) {
    ExportOptions options;
    options.filters.min_contrast = min_contrast;
    const DatasetInfo described = info(options);
    DatasetReader reader(described);
    std::size_t people = 0;
    std::size_t count = 0;
    for (Image image; reader.next(image);) {
      people += image.people.size();
      for (const Person& person : image.people) count += person.is_ignored ? 1 : 0;
    }
    EXPECT_GT(people, 20U);
    return count == people ? "all" : count == 0 ? "none" : "some";
  };
  EXPECT_STREQ(ignored(0), "none");
  EXPECT_STREQ(ignored(2.4), "none");
  EXPECT_STREQ(ignored(2.6), "all");
}

TEST_F(Exports, UnknownFormatsAndMissingNeedsAreNamed) {
  try {
    choose_formats({"mot", "docx", "mot", "yolo-pose"}, {"coco"}, "/outputs/formats");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 3U);
    EXPECT_EQ(error.problems()[0].where, "/outputs/formats/1");
    EXPECT_THAT(error.problems()[0].expected, ::testing::HasSubstr("visdrone-det"));
    EXPECT_EQ(error.problems()[1].found, "mot once more");
    EXPECT_THAT(error.problems()[2].expected, ::testing::HasSubstr("\"keypoints\""));
  }
}

TEST_F(Exports, TrajectoriesNeedNoImages) {
  for (const char* format : {"jupedsim", "eth-ucy", "trajnet"}) {
    EXPECT_NO_THROW(choose_formats({format}, {"trajectories"}, "")) << format;
    EXPECT_THROW(choose_formats({format}, {"coco"}, ""), InputError) << format;
  }
  EXPECT_THROW(choose_formats({"depth-exr"}, {"depth"}, ""), InputError);
}

TEST_F(Exports, ADamagedRecordIsNamedByItsLine) {
  std::string text = read_file(root_ / kCocoFile);
  text.replace(text.find("\"bbox\""), 6, "\"bbux\"");
  write_file_atomically(root_ / kCocoFile, text);
  try {
    exported("mot");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.problems()[0].where, ::testing::StartsWith("line "));
    EXPECT_THAT(error.problems()[0].found, ::testing::HasSubstr("bbox"));
  }
}

TEST(Mask, CountsGoThereAndBack) {
  const Bitmap mask{3, 2, 3, 2, {1, 0, 1, 1, 1, 0}};
  const auto runs = union_runs({mask}, 8, 6);
  EXPECT_EQ(decode_runs(encode_counts(runs), 48), runs);
  EXPECT_EQ(decode_bitmap(runs, 6).set, mask.set);
  EXPECT_THROW(decode_runs(encode_counts(runs), 49), InputError);
  EXPECT_THROW(decode_runs("~", 48), InputError);
}

}  // namespace
}  // namespace throng::formats
