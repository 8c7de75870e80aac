// Characters of the user's own: rigged models that assimp wrote, with descriptions.
#include "skinning/import/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/files/files.h"
#include "skinning/image.h"
#include "skinning/levels.h"
#include "skinning/population.h"
#include "skinning/population_files.h"
#include "spec/skinning/character_description.h"
#include "tests/skinning/rigged_scene.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImportTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder = fs::path(testing::TempDir()) / ("import_" + name);
    fs::remove_all(folder);
    fs::create_directories(folder);
    rig.name = mixamo_name;
  }
  void TearDown() override { fs::remove_all(folder); }

  /// Writes the model and a description of it.
  fs::path describe(const std::string& more = "", const std::string& height = "1.62",
                    const std::string& model = "model.glb", const std::string& name = "guide") {
    const fs::path file = folder / (name + ".json");
    write_file_atomically(file, R"({"name": ")" + name + R"(", "model": ")" + model +
                                    R"(", "license": "CC0-1.0", "height_m": )" + height + more +
                                    "}");
    return file;
  }

  void write_model(const std::string& format = "glb2", const std::string& file = "model.glb") {
    write_scene(*rigged_scene(rig), format, folder / file);
  }

  Population import(const fs::path& description, const ImportOptions& options = {}) {
    import_characters({description}, folder / "out", options);
    return load_population(folder / "out");
  }

  /// Errors of an import.
  std::string complaint(const fs::path& description, const ImportOptions& options = {}) {
    try {
      import_characters({description}, folder / "out", options);
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(folder / "out")) << "nothing half done";
      return error.what();
    }
    ADD_FAILURE() << "no error";
    return "";
  }

  fs::path folder;
  RiggedOptions rig;
};

constexpr const char* kStroll =
    R"(, "clips": {"walk": {"speed_mps": 1.08}})";  // for 1.62 m, not 1.8 m

struct Bounds {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(100);
  Eigen::Vector3f high = Eigen::Vector3f::Constant(-100);
};

Bounds bounding_box(const Mesh& mesh) {
  Bounds bounds;
  for (const Vertex& vertex : mesh.vertices) {
    const Eigen::Vector3f p(vertex.position[0], vertex.position[1], vertex.position[2]);
    bounds.low = bounds.low.cwiseMin(p);
    bounds.high = bounds.high.cwiseMax(p);
  }
  return bounds;
}

void expect_sound(const Population& people, double height_m) {
  ASSERT_EQ(people.characters.size(), 1U);
  const Character& character = people.characters.front();
  EXPECT_NEAR(character.stature_m, height_m, 1e-4);
  const Bounds bounds = bounding_box(character.levels.front());
  EXPECT_NEAR(bounds.low.z(), 0, 1e-4);
  EXPECT_NEAR(bounds.high.z(), height_m, 1e-3);
  EXPECT_NEAR(bounds.low.y(), -bounds.high.y(), 0.01);
  EXPECT_GT(bounds.high.x(), -bounds.low.x()) << "feet point forwards";
  for (const Mesh& mesh : character.levels) {
    for (const Vertex& vertex : mesh.vertices) {
      ASSERT_EQ(vertex.weights[0] + vertex.weights[1] + vertex.weights[2] + vertex.weights[3], 255);
      const auto bone = static_cast<Bone>(vertex.bones[0]);
      if (bone == Bone::left_hand || bone == Bone::left_shin) {
        ASSERT_GT(vertex.position[1], 0);
      }
      if (bone == Bone::right_hand || bone == Bone::right_shin) {
        ASSERT_LT(vertex.position[1], 0);
      }
      if (bone == Bone::head) {
        ASSERT_GT(vertex.position[2], 0.85 * height_m);
      }
    }
  }
  const std::vector<Clip> clips = standard_clips();
  EXPECT_EQ(people.clips.size(), clips.size());
  EXPECT_EQ(people.palettes.size(), clips.back().first + clips.back().frames);
}

struct Format {
  const char* id;
  const char* file;
};

class FormatTest : public ImportTest, public testing::WithParamInterface<Format> {};

TEST_P(FormatTest, IsReadInAnyUnitAndWithAnyAxisUp) {
  for (const bool z_up : {false, true}) {
    for (const float unit : {1.0F, 100.0F, 39.37F}) {
      rig.z_up = z_up;
      rig.unit = unit;
      write_model(GetParam().id, GetParam().file);
      fs::remove_all(folder / "out");
      expect_sound(import(describe("", "1.62", GetParam().file)), 1.62);
    }
  }
}

TEST_P(FormatTest, BringsItsOwnWalk) {
  rig.walks = true;
  write_model(GetParam().id, GetParam().file);
  const Population people = import(describe(kStroll, "1.62", GetParam().file));
  expect_sound(people, 1.62);
  // In its own clip the left arm is up, and in ours it is not.
  const Vertex hand = [&] {
    for (const Vertex& vertex : people.characters.front().levels.front().vertices) {
      if (static_cast<Bone>(vertex.bones[0]) == Bone::left_hand) return vertex;
    }
    return Vertex{};
  }();
  for (const Clip& clip : people.clips) {
    if (clip.name != "walk" && clip.name != "run") continue;
    for (std::uint32_t frame = 0; frame < clip.frames; frame += 5) {
      const Palette palette = people.palette(0, clip.first + frame);
      const float height_m = skin(hand, palette, palette, 0).z();
      if (clip.name == "walk") {
        EXPECT_GT(height_m, 1.5F) << clip.stride;
      } else {
        EXPECT_LT(height_m, 1.4F) << clip.stride;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Assimp, FormatTest,
                         testing::Values(Format{"glb2", "model.glb"}, Format{"gltf2", "model.gltf"},
                                         Format{"fbxa", "model.fbx"},
                                         Format{"collada", "model.dae"}),
                         [](const auto& rig_info) { return std::string(rig_info.param.id); });

TEST_F(ImportTest, ArmsOfATPoseComeDown) {
  rig.t_pose = true;
  write_model();
  const Population people = import(describe());
  expect_sound(people, 1.62);
  const Bounds bounds = bounding_box(people.characters.front().levels.front());
  EXPECT_LT(bounds.high.y(), 0.45F);
}

TEST_F(ImportTest, WeightsOfUnknownBonesGoToTheirParents) {
  rig.fingers = true;
  write_model();
  const Population people = import(describe());
  expect_sound(people, 1.62);
  float lowest = 1;
  for (const Vertex& vertex : people.characters.front().levels.front().vertices) {
    if (static_cast<Bone>(vertex.bones[0]) == Bone::left_hand) {
      lowest = std::min(lowest, vertex.position[2]);
    }
  }
  EXPECT_LT(lowest, 0.75F) << "fingertips hang on the hand";
}

TEST_F(ImportTest, BonesThatAreMissingArePlaced) {
  rig.name = [](Bone bone) {
    const bool left_out = bone == Bone::spine || bone == Bone::neck || bone == Bone::left_toe ||
                          bone == Bone::right_toe || bone == Bone::left_clavicle ||
                          bone == Bone::right_clavicle;
    return left_out ? "" : mixamo_name(bone);
  };
  write_model();
  expect_sound(import(describe()), 1.62);
}

TEST_F(ImportTest, TheDescriptionNamesBonesThatNobodyKnows) {
  rig.name = [](Bone bone) {
    return bone == Bone::left_thigh ? std::string("Stelze_1") : mixamo_name(bone);
  };
  write_model();
  expect_sound(import(describe(R"(, "bones": {"left_thigh": "Stelze_1"})")), 1.62);
}

// Like PeopleTest.FeetDoNotSkateAtAnySpeed.
TEST_F(ImportTest, FeetDoNotSkateInTheOwnWalkAtAnySpeed) {
  rig.walks = true;
  write_model();
  const Population people = import(describe(kStroll));
  Vertex ball = people.characters.front().levels.front().vertices.front();
  for (const Vertex& vertex : people.characters.front().levels.front().vertices) {
    if (static_cast<Bone>(vertex.bones[0]) == Bone::left_toe && vertex.position[2] < 0.001F &&
        (static_cast<Bone>(ball.bones[0]) != Bone::left_toe ||
         vertex.position[0] < ball.position[0])) {
      ball = vertex;
    }
  }
  ASSERT_EQ(static_cast<Bone>(ball.bones[0]), Bone::left_toe);
  for (double speed_mps = 0.4; speed_mps < 4; speed_mps += 0.3) {
    const std::vector<Moment> moments =
        straight_trajectory(std::vector<double>(70, speed_mps), 0.1);
    Appearance appearance;
    appearance.phase_offset = 0.6F;
    const MotionPlan plan(people, appearance, 1, moments, 0.1);
    const Contact contact = find_contact(people, 0, plan, moments, 0, 70, ball, 0.0025F, 0.1);
    EXPECT_GE(contact.landings, 2) << speed_mps;
    EXPECT_LT(contact.slide_m, 0.015) << speed_mps;
    EXPECT_GT(contact.lowest_m, -0.01) << speed_mps;
  }
}

// The made-up figure's legs are shorter than usual ones of its height, and so are its strides.
TEST_F(ImportTest, StridesFollowTheLengthOfTheLegs) {
  write_model();
  const Character character = import(describe()).characters.front();
  const auto joint = [&](Bone bone) { return character.joints[index_from(bone)]; };
  const float leg_m = (joint(Bone::left_shin) - joint(Bone::left_thigh)).norm() +
                      (joint(Bone::left_foot) - joint(Bone::left_shin)).norm();
  EXPECT_NEAR(character.gait_stature_m(), leg_m / 0.48F, 1e-4);
  EXPECT_NEAR(character.stature_m, 1.62, 1e-4);
}

TEST_F(ImportTest, NormalsAndTrianglesAreTurnedOutwards) {
  const auto levels = [&](bool are_normals_turned, bool are_triangles_turned) {
    const auto scene = rigged_scene(rig);
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
      aiMesh& mesh = *scene->mMeshes[i];
      for (unsigned k = 0; are_normals_turned && k < mesh.mNumVertices; ++k) {
        mesh.mNormals[k] = -mesh.mNormals[k];
      }
      for (unsigned k = 0; are_triangles_turned && k < mesh.mNumFaces; ++k) {
        std::swap(mesh.mFaces[k].mIndices[1], mesh.mFaces[k].mIndices[2]);
      }
    }
    write_scene(*scene, "glb2", folder / "model.glb");
    fs::remove_all(folder / "out");
    return import(describe()).characters.front().levels;
  };
  for (const auto& [normals, triangles] :
       {std::pair{true, false}, std::pair{false, true}, std::pair{true, true}}) {
    const Mesh mesh = levels(normals, triangles).front();
    double agreement = 0;
    double volume = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) {
        const Vertex& vertex = mesh.vertices[mesh.indices[i + k]];
        return Eigen::Vector3f(vertex.position[0], vertex.position[1], vertex.position[2]);
      };
      const Eigen::Vector3f turn = (at(1) - at(0)).cross(at(2) - at(0));
      const Vertex& first = mesh.vertices[mesh.indices[i]];
      agreement += turn.dot(Eigen::Vector3f(first.normal[0], first.normal[1], first.normal[2]));
      volume += at(0).dot(at(1).cross(at(2)));
    }
    EXPECT_GT(agreement, 0) << normals << triangles;
    EXPECT_GT(volume, 0) << normals << triangles;
  }
}

TEST_F(ImportTest, ClipsMayComeFromAnotherFile) {
  write_model();
  rig.walks = true;
  rig.unit = 1;
  rig.z_up = true;
  write_model("glb2", "moves.glb");
  const Population people =
      import(describe(R"(, "clips": {"walk": {"file": "moves.glb", "speed_mps": 1.08}})"));
  expect_sound(people, 1.62);
  rig.z_up = false;
  rig.unit = 100;
  fs::rename(folder / "out", folder / "other");
  write_model();
  const Population own = import(describe(kStroll));
  // The same motion from either source.
  float apart_m = 0;
  for (std::size_t i = 0; i < own.palettes.size(); ++i) {
    const Palette a = own.palettes[i];
    const Palette b = people.palettes[i];
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      apart_m = std::max(apart_m, (a[bone] - b[bone]).norm());
    }
  }
  EXPECT_LT(apart_m, 0.02F);
}

TEST_F(ImportTest, ManyTrianglesAreSimplifiedToLevels) {
  rig.cuts = 16;
  write_model();
  const std::size_t original = 22U * 6 * 16 * 16 * 2;
  ASSERT_GT(original, 60'000U);
  const Population people = import(describe());
  expect_sound(people, 1.62);
  const std::vector<Mesh>& levels = people.characters.front().levels;
  ASSERT_EQ(levels.size(), kDetailLevels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::size_t max_triangles = kDetailLevels[i].triangles;
    // The figure's 22 boxes cannot be few triangles without losing one: then nothing is taken away.
    const bool kept = i > 0 && levels[i].indices.size() == levels[i - 1].indices.size();
    EXPECT_TRUE(!kept || max_triangles < 100) << "level " << i;
    EXPECT_TRUE(kept || levels[i].indices.size() / 3 <= max_triangles + max_triangles / 4)
        << "level " << i;
    EXPECT_GE(levels[i].indices.size() / 3, max_triangles / 4);
    const Bounds bounds = bounding_box(levels[i]);
    EXPECT_NEAR(bounds.high.z(), 1.62, 0.02);
    EXPECT_NEAR(bounds.low.z(), 0, 0.02);
  }
}

TEST_F(ImportTest, ImagesGetThePopulationsSize) {
  rig.image = "cloth.png";
  write_file_atomically(folder / "cloth.png", encode_png(plain(48, {10, 200, 30})));
  write_model("gltf2", "model.gltf");
  ImportOptions options;
  options.texture_size = 64;
  const Population people = import(describe("", "1.62", "model.gltf"), options);
  EXPECT_EQ(people.texture_size, 64);
  ASSERT_EQ(people.textures.size(), 1U);
  ASSERT_EQ(people.textures.front().rgba.size(), 64U * 64 * 4);
  EXPECT_NEAR(people.textures.front().rgba[1], 200, 2);
}

TEST_F(ImportTest, IsPutAmongOthersAndGivesTheSameTwice) {
  write_model();
  import_characters({describe()}, folder / "first", {});
  const fs::path second = describe("", "1.9", "model.glb", "tall_one");
  ImportOptions options;
  options.with = folder / "first";
  import_characters({second}, folder / "both", options);
  const Population both = load_population(folder / "both");
  ASSERT_EQ(both.characters.size(), 2U);
  EXPECT_EQ(both.characters[0].name, "guide");
  EXPECT_EQ(both.characters[1].name, "tall_one");
  EXPECT_THAT(read_file(folder / "both/NOTICE.txt"), HasSubstr("tall_one: CC0-1.0"));
  EXPECT_NE(both.content_hash, read_index(folder / "first").content_hash);

  import_characters({second}, folder / "again", options);
  for (const char* file : {"population.json", "palettes.bin", "tall_one.glb", "NOTICE.txt"}) {
    EXPECT_EQ(read_file(folder / "again" / file), read_file(folder / "both" / file)) << file;
  }
  // Into the same folder, too.
  import_characters({second}, folder / "first", options);
  EXPECT_EQ(read_file(folder / "first/population.json"),
            read_file(folder / "both/population.json"));
  EXPECT_THROW(import_characters({second}, folder / "first", options), InputError);
}

// The error, and how to fix it.

TEST_F(ImportTest, AModelWithoutBonesIsRefused) {
  rig.bones = false;
  write_model();
  const std::string message = complaint(describe());
  EXPECT_THAT(message, HasSubstr("model.glb"));
  EXPECT_THAT(message, HasSubstr("without bones"));
  EXPECT_THAT(message, HasSubstr("armature"));
}

TEST_F(ImportTest, UnknownBonesAreListedWithTheNeededOnes) {
  rig.name = [](Bone bone) {
    return bone == Bone::left_thigh        ? std::string("linker_tigh")
           : bone == Bone::right_upper_arm ? std::string("Oberarm.R")
                                           : mixamo_name(bone);
  };
  write_model();
  const std::string message = complaint(describe());
  EXPECT_THAT(message, HasSubstr("guide.json"));
  EXPECT_THAT(message, HasSubstr("/bones/left_thigh"));
  EXPECT_THAT(message, HasSubstr("/bones/right_upper_arm"));
  EXPECT_THAT(message, HasSubstr("not recognized: Oberarm.R, linker_tigh"));
  EXPECT_THAT(message, HasSubstr(R"("left_thigh": "linker_tigh")"));
}

TEST_F(ImportTest, WrongNamesInTheDescriptionAreRefused) {
  write_model();
  const std::string message = complaint(
      describe(R"(, "bones": {"left_leg": "mixamorig:LeftUpLeg", "head": "mixamorig:Haed"})"));
  EXPECT_THAT(message, HasSubstr("/bones/left_leg"));
  EXPECT_THAT(message, HasSubstr("left_clavicle"));
  EXPECT_THAT(message, HasSubstr("/bones/head"));
  EXPECT_THAT(message, HasSubstr("\"mixamorig:Head\""));
}

TEST_F(ImportTest, AbsurdHeightsAreRefused) {
  write_model();
  for (const char* height : {"0.03", "300", "-1.7", "\"tall\"", "null"}) {
    const std::string message = complaint(describe("", height));
    EXPECT_THAT(message, HasSubstr("/height_m")) << height;
    EXPECT_THAT(message, HasSubstr("0.5 to 2.5")) << height;
  }
}

TEST_F(ImportTest, AMeshOfAnotherSizeThanItsSkeletonIsRefused) {
  for (const float scale : {0.01F, 100.0F}) {
    rig.mesh_scale = scale;
    write_model();
    const std::string message = complaint(describe());
    EXPECT_THAT(message, HasSubstr("on a skeleton from"));
    EXPECT_THAT(message, HasSubstr("one unit"));
  }
}

TEST_F(ImportTest, LeftAndRightMustNotBeSwapped) {
  rig.swapped = true;
  write_model();
  EXPECT_THAT(complaint(describe()), HasSubstr("swap left and right"));
}

TEST_F(ImportTest, ClipsThatAreNotThereAreRefusedWithThoseThatAre) {
  rig.walks = true;
  write_model();
  const std::string message =
      complaint(describe(R"(, "clips": {"walk": {"name": "Walk", "speed_mps": 1.1}})"));
  EXPECT_THAT(message, HasSubstr("/clips/walk/name"));
  EXPECT_THAT(message, HasSubstr("Stroll"));
  rig.walks = false;
  write_model();
  EXPECT_THAT(complaint(describe(kStroll)), HasSubstr("export it with its animations"));
}

TEST_F(ImportTest, SpeedsAtWhichFeetSlideAreRefused) {
  rig.walks = true;
  write_model();
  const std::string message =
      complaint(describe(R"(, "clips": {"walk": {"name": "Stroll", "speed_mps": 3}})"));
  EXPECT_THAT(message, HasSubstr("/clips/walk/speed_mps"));
  EXPECT_THAT(message, HasSubstr("1.0"));  // what its feet do, in m/s
  EXPECT_THAT(complaint(describe(R"(, "clips": {"walk": {"name": "Stroll", "speed_mps": 40}})")),
              HasSubstr("0.2 to 3"));
}

TEST_F(ImportTest, FilesThatAreMissingOrOfAnotherKindAreNamed) {
  EXPECT_THAT(complaint(describe()), HasSubstr("model.glb"));
  write_file_atomically(folder / "model.glb", "this is not a model");
  EXPECT_THAT(complaint(describe()), HasSubstr("FBX, DAE"));
  EXPECT_THAT(complaint(folder / "nobody.json"), HasSubstr("nobody.json"));
  write_file_atomically(folder / "list.json", "[1, 2]");
  EXPECT_THAT(complaint(folder / "list.json"), HasSubstr("height_m"));
  rig.image = "nowhere.png";
  write_model("gltf2", "model.gltf");
  EXPECT_THAT(complaint(describe("", "1.7", "model.gltf")), HasSubstr("nowhere.png"));
  write_file_atomically(folder / "nowhere.png", "GIF89a");
  EXPECT_THAT(complaint(describe("", "1.7", "model.gltf")), HasSubstr("PNG or JPEG"));
}

TEST_F(ImportTest, TheOldNameOfTheLicenseIsReadWithAWarning) {
  const fs::path file = folder / "old.json";
  write_file_atomically(
      file, R"({"name": "a", "model": "a.glb", "height_m": 1.7, "licence": "CC0-1.0"})");
  testing::internal::CaptureStderr();
  EXPECT_EQ(read_description(file).license, "CC0-1.0");
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("old.json: /licence is deprecated, use \"license\""));
}

TEST_F(ImportTest, EverythingThatIsWrongInADescriptionIsSaidAtOnce) {
  const fs::path file = folder / "bad.json";
  write_file_atomically(file, R"({"name": "a b", "modle": "x", "height_m": 17, "sex": "other",
      "age_years": -1, "bones": {"head": 7}, "clips": {"wlak": {}, "run": {"name": "Run"}}})");
  const std::string message = complaint(file);
  for (const char* where :
       {"/name", "/modle", "\"model\"?", "/model", "/height_m", "/license", "/sex", "/age_years",
        "/bones/head", "/clips/wlak", "/clips/run/speed_mps"}) {
    EXPECT_THAT(message, HasSubstr(where));
  }
  for (const char* expected :
       {R"(/modle: unknown field "modle"; did you mean "model"?)",
        "/model: found nothing, expected a string that is not empty",
        "/height_m: found 17, expected 0.5 to 2.5 (in meters, from the soles",
        R"(/sex: found "other", expected "male" or "female")",
        "/age_years: found -1, expected 1 to 110 (years)",
        "/bones/head: found 7, expected the name of a bone of the model",
        R"(/clips/wlak: unknown field "wlak"; did you mean "walk"?)",
        "/clips/run/speed_mps: found nothing, expected 1 to 12 (meters per second"}) {
    EXPECT_THAT(message, HasSubstr(std::string("bad.json: ") + expected));
  }
  write_file_atomically(file, R"({"name": "a", "model": "a.glb", "height_m": 1.7, "bones": [],
      "license": "MIT", "licence": "MIT", "clips": 3})");
  const std::string more = complaint(file);
  EXPECT_THAT(more, HasSubstr(R"(/bones: found [], expected an object such as {"left)"));
  EXPECT_THAT(more, HasSubstr("/clips: found 3, expected an object such as {\"walk\""));
  EXPECT_THAT(more, HasSubstr("bad.json: /licence: found both"));
}

TEST_F(ImportTest, AFolderWithOtherThingsInItIsLeftAlone) {
  write_model();
  write_file_atomically(folder / "papers/thesis.txt", "three years of work");
  EXPECT_THROW(import_characters({describe()}, folder / "papers", {}), InputError);
  EXPECT_TRUE(fs::exists(folder / "papers/thesis.txt"));
}

}  // namespace
}  // namespace throng::skinning
