#include "annotate/people/coco.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "annotate/people/coco_records.h"
#include "annotate/people/person_facts.h"
#include "base/error.h"
#include "base/files/files.h"
#include "tests/annotate/rle.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Coco : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::path(testing::TempDir()) / ("coco_" + name_of_test());
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (int i = 0; i < kFrames; ++i) {
      SyntheticScene scene;
      scene.seed = i;
      scene.people = i == 2 ? 0 : 15;  // an image without anybody is an image all the same
      frames.push_back(synthetic_frame(scene));
      frames.back().index = i;
      frames.back().time_s = 0.1 * i;
    }
  }
  void TearDown() override { fs::remove_all(folder); }

  static constexpr int kFrames = 6;

  static std::string name_of_test() {
    return testing::UnitTest::GetInstance()->current_test_info()->name();
  }

  CocoImage image_of(int i) const {
    CocoImage image;
    image.id = i + 1;
    image.file_name = "run001/d1/\"frame\" " + std::to_string(i) + ".jpg";
    image.run = "run001";
    image.run_index = 1;
    image.camera_id = "d1";
    image.frame_index = frames[i].index;
    image.time_s = frames[i].time_s;
    image.camera = frames[i].camera;
    if (i > 0) {
      image.density_file = "density/" + std::to_string(i) + ".npz";
      image.density_count = 10 + i;
    }
    return image;
  }

  fs::path write_shard(const std::string& name, int begin, int end) const {
    CocoShardWriter writer(folder / name);
    for (int i = begin; i < end; ++i) writer.add(image_of(i), label_people(frames[i]));
    writer.finish();
    return folder / name;
  }

  std::string merge(const std::vector<fs::path>& shards) const {
    merge_coco(shards, folder / "coco.json", "a test");
    return read_file(folder / "coco.json");
  }

  // The message of the error that the merge must fail with.
  std::string merge_error(const std::vector<fs::path>& shards) const {
    try {
      merge(shards);
    } catch (const EnvironmentError& error) {
      EXPECT_FALSE(fs::exists(folder / "coco.json"));
      return error.what();
    }
    ADD_FAILURE() << "the merge went through";
    return {};
  }

  fs::path folder;
  std::vector<render::Frame> frames;
};

TEST_F(Coco, HoldsTheFieldsThatALoaderNeeds) {
  const json coco = json::parse(merge({write_shard("all", 0, kFrames)}));
  EXPECT_EQ(coco.at("info").at("description"), "a test");
  EXPECT_EQ(coco.at("licenses").at(0).at("name"), "CC0-1.0");
  EXPECT_EQ(coco.at("categories"),
            json::parse(R"([{"id":1,"name":"person","supercategory":"person"}])"));
  ASSERT_EQ(coco.at("images").size(), std::size_t{kFrames});

  std::set<std::int64_t> ids;
  std::size_t annotations = 0;
  for (int i = 0; i < kFrames; ++i) {
    const json& image = coco["images"][i];
    const CocoImage expected = image_of(i);
    EXPECT_EQ(image.at("id"), expected.id);
    EXPECT_EQ(image.at("file_name"), expected.file_name);
    EXPECT_EQ(image.at("width"), frames[i].width());
    EXPECT_EQ(image.at("height"), frames[i].height());
    EXPECT_EQ(image.at("run"), "run001");
    EXPECT_EQ(image.at("camera_id"), "d1");
    EXPECT_EQ(image.at("frame"), i);
    EXPECT_DOUBLE_EQ(image.at("time_s"), frames[i].time_s);
    EXPECT_EQ(image.contains("density_file"), i > 0);
    if (i > 0) {
      EXPECT_EQ(image.at("density_file"), expected.density_file);
      EXPECT_EQ(image.at("density_count"), expected.density_count);
    }
    const FrameLabels labels = label_people(frames[i]);
    EXPECT_EQ(image.at("counts").at("visible"), labels.people.size());
    EXPECT_EQ(image.at("counts").at("all"), labels.people.size() + labels.hidden.size());
    ASSERT_EQ(image.value("hidden", json::array()).size(), labels.hidden.size());
    for (std::size_t j = 0; j < labels.hidden.size(); ++j) {
      EXPECT_EQ(image["hidden"][j].at("track_id"), 1'000'000 + labels.hidden[j].agent + 1);
      EXPECT_NEAR(image["hidden"][j].at("bbox_amodal")[0].get<double>(),
                  labels.hidden[j].amodal_box.min().x(), 6e-3);
    }
    annotations += labels.people.size();
  }
  ASSERT_EQ(coco.at("annotations").size(), annotations);
  ASSERT_GT(annotations, 30U);
  for (const json& annotation : coco["annotations"]) {
    EXPECT_TRUE(ids.insert(annotation.at("id").get<std::int64_t>()).second) << "ids are unique";
    EXPECT_EQ(annotation.at("category_id"), 1);
    EXPECT_EQ(annotation.at("iscrowd"), 0);
  }
}

TEST_F(Coco, ImagesNameTheirLensAndSensor) {
  const auto record_of = [](const CocoImage& image) {
    std::string text;
    append_image_record(text, image, {});
    return json::parse(text);
  };
  CocoImage image = image_of(0);
  EXPECT_EQ(record_of(image)["camera"]["model"], "pinhole");
  EXPECT_FALSE(record_of(image)["camera"].contains("distortion"));
  EXPECT_FALSE(record_of(image).contains("sensor"));
  image.sensor = R"({"iso":400})";
  using camera::Distortion;
  image.camera.intrinsics.distortion.emplace(
      Distortion::Model::brown_conrady, Distortion::Coefficients{.1, .2, .3, .4, .5, .6, 0, 0});
  EXPECT_EQ(record_of(image)["sensor"]["iso"], 400);
  EXPECT_EQ(record_of(image)["camera"]["model"], "brown_conrady");
  EXPECT_EQ(record_of(image)["camera"]["distortion"],
            json::parse(R"({"k1": 0.1, "k2": 0.2, "p1": 0.3, "p2": 0.4, "k3": 0.5, "k4": 0.6,
                            "k5": 0.0, "k6": 0.0})"));
  image.camera.intrinsics.distortion.emplace(Distortion::Model::fisheye,
                                             Distortion::Coefficients{.1, .2, .3, .4});
  EXPECT_EQ(record_of(image)["camera"]["distortion"],
            json::parse(R"({"k1": 0.1, "k2": 0.2, "k3": 0.3, "k4": 0.4})"));
}

TEST_F(Coco, EachAnnotationIsItsLabel) {
  const json coco = json::parse(merge({write_shard("all", 0, kFrames)}));
  std::size_t next = 0;
  for (int i = 0; i < kFrames; ++i) {
    for (const PersonLabel& label : label_people(frames[i]).people) {
      const json& annotation = coco["annotations"].at(next++);
      EXPECT_EQ(annotation.at("image_id"), i + 1);
      EXPECT_EQ(annotation.at("track_id"), 1'000'000 + label.agent + 1);
      const PixelBox& box = label.box;
      EXPECT_EQ(annotation.at("bbox"), json({box.x, box.y, box.width, box.height}));
      EXPECT_TRUE(annotation["bbox"][0].is_number_float());
      EXPECT_EQ(annotation.at("area"), label.area_px);
      const json& mask = annotation.at("segmentation");
      EXPECT_EQ(mask.at("size"), json({frames[i].height(), frames[i].width()}));
      EXPECT_EQ(
          mask_of_runs(runs_of_counts(mask.at("counts")), frames[i].width(), frames[i].height()),
          mask_of_runs(label.mask, frames[i].width(), frames[i].height()));
      EXPECT_NEAR(annotation.at("visibility").get<double>(), label.visibility, 5e-4);
      EXPECT_EQ(annotation.at("area_amodal"), label.person.amodal_area_px);
      EXPECT_NEAR(annotation.at("bbox_amodal")[2].get<double>(),
                  label.person.amodal_box.sizes().x(), 6e-3);
      EXPECT_NEAR(annotation.at("velocity")[1].get<double>(), label.person.velocity.y(), 6e-3);
    }
  }
}

// A reader with K, R, t and position alone finds the person's place in the image.
TEST_F(Coco, PositionsProjectFromTheFileAlone) {
  const json coco = json::parse(merge({write_shard("all", 0, kFrames)}));
  const auto number = [](const json& value) { return value.get<double>(); };
  for (const json& annotation : coco["annotations"]) {
    const json& camera =
        coco["images"][annotation.at("image_id").get<std::size_t>() - 1].at("camera");
    Eigen::Matrix3d K, R;
    Eigen::Vector3d t, center, position;
    for (int row = 0; row < 3; ++row) {
      t[row] = number(camera.at("t")[row]);
      center[row] = number(camera.at("centre")[row]);
      position[row] = number(annotation.at("position")[row]);
      for (int column = 0; column < 3; ++column) {
        K(row, column) = number(camera.at("K")[row][column]);
        R(row, column) = number(camera.at("R")[row][column]);
      }
    }
    EXPECT_LT((R * center + t).norm(), 1e-9);
    const Eigen::Vector3d seen = K * (R * position + t);
    const json& box = annotation.at("bbox_amodal");
    // The scene puts feet in the middle of the amodal box's lower edge.
    EXPECT_NEAR(seen.x() / seen.z() + 0.5, number(box[0]) + number(box[2]) / 2, 0.02);
    EXPECT_NEAR(seen.y() / seen.z() + 0.5, number(box[1]) + number(box[3]), 0.02);
    EXPECT_NEAR(number(annotation.at("head")[0]), number(box[0]) + number(box[2]) / 2, 0.02);
    EXPECT_NEAR(number(annotation.at("head")[1]), number(box[1]) + 0.1 * number(box[3]), 0.02);
  }
}

TEST_F(Coco, TracksHoldConstantFieldsOnce) {
  const skinning::Population population = [] {
    skinning::Population people;
    people.characters.resize(3);
    return people;
  }();
  world::Trace trace;
  trace.header.role.resize(30);
  trace.header.group.assign(30, 4);
  trace.time_s = {0};
  trace.flags.assign(30, world::kPresent);
  const PersonFacts facts(trace, population, {});
  std::set<std::int64_t> expected;
  CocoShardWriter writer(folder / "facts");
  for (int i = 0; i < kFrames; ++i) {
    CocoImage image = image_of(i);
    image.facts = &facts;
    const FrameLabels labels = label_people(frames[i]);
    writer.add(image, labels);
    for (const PersonLabel& label : labels.people) expected.insert(1'000'000 + label.agent + 1);
  }
  writer.finish();
  const json coco = json::parse(merge({folder / "facts"}));
  std::vector<std::int64_t> ids;
  for (const json& track : coco.at("tracks")) {
    ids.push_back(track.at("id"));
    EXPECT_EQ(track.at("run"), "run001");
    EXPECT_EQ(track.at("group"), 4);
    EXPECT_EQ(track.at("attributes").at("age_band"), "adult");
  }
  EXPECT_EQ(ids, std::vector<std::int64_t>(expected.begin(), expected.end()));
  EXPECT_FALSE(coco["annotations"][0].contains("attributes"));
}

TEST_F(Coco, LyingPeopleAreLabeledSoInAnyState) {
  skinning::Population population;
  population.characters.resize(3);
  world::Trace trace;
  trace.header.state_names = {"Walk"};
  trace.header.role.resize(30);
  trace.time_s = {0, 0.1, 0.2};
  trace.state.assign(90, 0);
  trace.flags.assign(90, world::kPresent);
  for (std::size_t agent = 0; agent < 30; agent += 2) {
    trace.flags[trace.at(1, agent)] |= world::kFallen;
  }
  const PersonFacts facts(trace, population, {});
  for (std::uint32_t agent = 0; agent < 30; ++agent) {
    const auto state_at = [&](double time_s) {
      std::string text = "{\"agent\":0";
      facts.append(text, agent, time_s, {}, 0.0);
      return json::parse(text + "}").at("state").get<std::string>();
    };
    EXPECT_EQ(state_at(0.05), "waiting");
    EXPECT_EQ(state_at(0.15), agent % 2 == 0 ? "lying" : "waiting");
    EXPECT_EQ(state_at(0.25), "waiting");
  }
}

TEST_F(Coco, DronesHaveACategoryAndTracksOfTheirOwn) {
  render::Frame& frame = frames[0];
  render::ObjectInView drone;
  drone.id = render::kIdDrone + 1;
  drone.number = 1;
  drone.position = {1, 2, 3};
  drone.amodal_box = {Eigen::Vector2d(20, 30), Eigen::Vector2d(24, 33)};
  drone.amodal_area_px = 12;
  for (int y = 30; y < 33; ++y) {
    for (int x = 20; x < 24; ++x) {
      if (x != 20) frame.id[static_cast<std::size_t>(y * frame.width() + x)] = render::kIdDrone + 1;
    }
  }
  frame.objects.push_back(drone);
  const std::vector<std::string> ids = {"camera", "other"};
  CocoImage image = image_of(0);
  image.drone_ids = &ids;
  const FrameLabels labels = label_people(frame);
  CocoShardWriter writer(folder / "drones");
  writer.add(image, labels);
  writer.finish();
  merge_coco({folder / "drones"}, folder / "coco.json", "a test", {.drones = true});
  const json coco = json::parse(read_file(folder / "coco.json"));
  EXPECT_EQ(coco["categories"][1]["name"], "drone");
  EXPECT_EQ(coco["images"][0]["counts"]["drones"], 1);
  EXPECT_EQ(coco["images"][0]["counts"]["visible"], labels.people.size());
  const json& record = coco["annotations"].back();
  EXPECT_EQ(record["category_id"], 2);
  EXPECT_EQ(record["bbox"], json({21, 30, 3, 3}));
  EXPECT_EQ(record["area"], 9);
  EXPECT_EQ(record["visibility"], 0.75);
  EXPECT_EQ(record["position"], json({1, 2, 3}));
  EXPECT_EQ(coco["tracks"].back()["id"], record["track_id"]);
  EXPECT_EQ(coco["tracks"].back()["drone"], "other");
}

TEST_F(Coco, VehiclesHaveCategoriesAndTracksOfTheirOwn) {
  render::Frame& frame = frames[0];
  const std::uint32_t prop = 7;
  render::ObjectInView train;
  train.id = render::kIdProp + prop;
  train.number = 2;
  train.surface = world::SemanticClass::train;
  train.position = {5, 6, 0};
  train.yaw_rad = 0.5;
  train.box_middle = {5, 6, 2};
  train.box_size = {20, 3, 4};
  train.amodal_box = {Eigen::Vector2d(20, 30), Eigen::Vector2d(30, 34)};
  train.amodal_area_px = 80;
  for (int y = 30; y < 34; ++y) {
    for (int x = 20; x < 30; ++x) {
      frame.id[static_cast<std::size_t>(y * frame.width() + x)] = train.id;
    }
  }
  frame.objects.push_back(train);
  const FrameLabels labels = label_people(frame);
  CocoShardWriter writer(folder / "vehicles");
  writer.add(image_of(0), labels);
  writer.finish();
  merge_coco({folder / "vehicles"}, folder / "coco.json", "a test", {.vehicles = true});
  const json coco = json::parse(read_file(folder / "coco.json"));
  ASSERT_EQ(coco["categories"].size(), 7);
  EXPECT_EQ(coco["categories"][1]["name"], "car");
  EXPECT_EQ(coco["categories"][2]["name"], "train");
  EXPECT_EQ(coco["images"][0]["counts"]["vehicles"], 1);
  EXPECT_FALSE(coco["images"][0]["counts"].contains("drones"));
  const json& record = coco["annotations"].back();
  EXPECT_EQ(record["category_id"], 4);
  EXPECT_EQ(record["bbox"], json({20, 30, 10, 4}));
  EXPECT_EQ(record["visibility"], 0.5);
  EXPECT_EQ(record["box_3d"], json({5, 6, 2, 20, 3, 4}));
  EXPECT_EQ(record["heading"], 0.5);
  EXPECT_EQ(record["velocity"], json({0, 0, 0}));
  const json& track = coco["tracks"].back();
  EXPECT_EQ(track["id"], record["track_id"]);
  EXPECT_EQ(track["id"].get<std::int64_t>() % kTrackIdsPerRun, kFirstVehicleNumber + 2 + 1);
  EXPECT_EQ(track["vehicle"], "train");
  EXPECT_EQ(track["prop"], prop);
}

TEST_F(Coco, AHeadBehindTheCameraIsNull) {
  render::Frame& frame = frames[0];
  for (render::PersonInView& person : frame.people) person.head = {0, 0, 1000};
  const json coco = json::parse(merge({write_shard("all", 0, 1)}));
  for (const json& annotation : coco["annotations"]) EXPECT_TRUE(annotation.at("head").is_null());
}

TEST_F(Coco, BytesDoNotDependOnSharding) {
  const std::string whole = merge({write_shard("all", 0, kFrames)});
  EXPECT_EQ(merge({write_shard("a", 0, 1), write_shard("b", 1, 4), write_shard("none", 4, 4),
                   write_shard("c", 4, kFrames)}),
            whole);
}

TEST_F(Coco, AnEmptyDatasetIsValid) {
  const json coco = json::parse(merge({write_shard("none", 0, 0)}));
  EXPECT_TRUE(coco.at("images").is_array());
  EXPECT_TRUE(coco.at("annotations").empty());
}

TEST_F(Coco, IdsStayExactInDoubles) {
  CocoImage image = image_of(0);
  image.id = kMaxImageId;
  FrameLabels labels = label_people(frames[0]);
  labels.people[0].agent = kFirstVehicleNumber - 1;
  CocoShardWriter writer(folder / "big");
  writer.add(image, labels);
  writer.finish();
  const json coco = json::parse(merge({folder / "big"}));
  EXPECT_LE(coco["annotations"][0]["id"].get<std::int64_t>(), std::int64_t{1} << 53);
}

TEST_F(Coco, AnUnfinishedShardIsRefused) {
  {
    CocoShardWriter writer(folder / "killed");
    writer.add(image_of(0), label_people(frames[0]));
  }
  EXPECT_NE(merge_error({folder / "killed"}).find("killed"), std::string::npos);
}

TEST_F(Coco, ARestartedShardReplacesTheEarlierAttempt) {
  const std::string whole = merge({write_shard("shard", 0, kFrames)});
  write_shard("shard", 0, 1);
  EXPECT_EQ(merge({write_shard("shard", 0, kFrames)}), whole);
}

// A file may be cut anywhere: inside a line, after one, or down to nothing.
TEST_F(Coco, ATruncatedFileIsNamedWithItsLine) {
  const fs::path shard = write_shard("shard", 0, kFrames);
  const fs::path file = shard / "annotations.jsonl";
  const std::string text = read_file(file);
  for (const std::size_t size :
       {std::size_t{0}, text.size() / 3, text.find('\n') + 1, text.find('\n'), text.size() - 1}) {
    fs::resize_file(file, size);
    const auto lines = std::count(text.begin(), text.begin() + size, '\n');
    const std::string error = merge_error({shard});
    EXPECT_NE(error.find("annotations.jsonl: line " + std::to_string(lines + 1) + ":"),
              std::string::npos)
        << error;
    write_file_atomically(file, text);
  }
  EXPECT_NO_THROW(merge({shard}));
}

TEST_F(Coco, ADamagedLineIsNamed) {
  const fs::path shard = write_shard("shard", 0, kFrames);
  std::string text = read_file(shard / "images.jsonl");
  text[text.find('\n') + 5] = '\n';
  write_file_atomically(shard / "images.jsonl", text);
  EXPECT_NE(merge_error({shard}).find("images.jsonl: line 2"), std::string::npos);
}

TEST_F(Coco, AFolderThatCannotBeMadeIsTheMachinesFault) {
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(CocoShardWriter(folder / "file" / "shard"), EnvironmentError);
}

}  // namespace
}  // namespace throng::annotate
