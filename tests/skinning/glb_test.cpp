#include "skinning/glb.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/skinning/made_up.h"

namespace throng::skinning {
namespace {

namespace fs = std::filesystem;

class GlbTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::path(testing::TempDir()) /
             testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path write(const std::string& bytes) const {
    const fs::path path = folder / "made_up.glb";
    write_file_atomically(path, bytes);
    return path;
  }

  fs::path folder;
};

TEST_F(GlbTest, WrittenFilesAreReadBackThroughAssimp) {
  const CharacterAsset asset = made_up_asset();
  const CharacterAsset read = read_glb(write(encode_glb(asset)));

  EXPECT_EQ(read.name, "made_up");
  EXPECT_EQ(read.images, asset.images);
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    EXPECT_LT((read.joints[bone] - asset.joints[bone]).norm(), 1e-5F) << kBoneNames[bone];
  }
  ASSERT_EQ(read.levels.size(), asset.levels.size());
  const Mesh& mesh = read.levels[0];
  const Mesh& original = asset.levels[0];
  ASSERT_EQ(mesh.vertices.size(), original.vertices.size());
  EXPECT_EQ(mesh.indices, original.indices);
  ASSERT_EQ(mesh.parts.size(), original.parts.size());
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    EXPECT_EQ(mesh.parts[i].first_index, original.parts[i].first_index);
    EXPECT_EQ(mesh.parts[i].index_count, original.parts[i].index_count);
    EXPECT_EQ(mesh.parts[i].texture, original.parts[i].texture);
    EXPECT_EQ(mesh.parts[i].tint, original.parts[i].tint);
    EXPECT_EQ(mesh.parts[i].alpha_tested, original.parts[i].alpha_tested);
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(mesh.vertices[i].position, original.vertices[i].position);
    EXPECT_EQ(mesh.vertices[i].normal, original.vertices[i].normal);
    EXPECT_NEAR(mesh.vertices[i].uv[0], original.vertices[i].uv[0], 1e-6);
    EXPECT_NEAR(mesh.vertices[i].uv[1], original.vertices[i].uv[1], 1e-6);
  }
}

TEST_F(GlbTest, APortraitKeepsBothOfItsImages) {
  CharacterAsset asset = made_up_asset();
  asset.levels[1].parts = {{0, 63, 1, Tint::portrait, false, 0}};
  const CharacterAsset read = read_glb(write(encode_glb(asset)));
  ASSERT_EQ(read.levels[1].parts.size(), 1U);
  const Part& part = read.levels[1].parts.front();
  EXPECT_EQ(part.tint, Tint::portrait);
  EXPECT_EQ(read.images.at(static_cast<std::size_t>(part.texture)), asset.images[1]);
  EXPECT_EQ(read.images.at(static_cast<std::size_t>(part.shades)), asset.images[0]);
  EXPECT_EQ(read.levels[0].parts.front().shades, -1);
}

TEST_F(GlbTest, APortraitWithOneImageIsRefused) {
  CharacterAsset asset = made_up_asset();
  asset.levels[1].parts = {{0, 63, 1, Tint::portrait, false, -1}};
  EXPECT_THROW(read_glb(write(encode_glb(asset))), InputError);
}

TEST_F(GlbTest, SkinningIsTheSameAfterReading) {
  CharacterAsset asset = made_up_asset();
  asset.levels[1].vertices.front().bones = {kStillBone, 0, 0, 0};
  const CharacterAsset read = read_glb(write(encode_glb(asset)));
  Pose pose;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    pose.rotation[bone] = turn_y(0.1 * static_cast<double>(bone)) * turn_z(0.2);
  }
  pose.shift = {0.1F, 0.2F, 0.3F};
  const Palette palette = pose_palette(asset.joints, pose);
  for (std::size_t i = 0; i < asset.levels[1].vertices.size(); ++i) {
    const Eigen::Vector3f expected = skin(asset.levels[1].vertices[i], palette, palette, 0);
    const Eigen::Vector3f found = skin(read.levels[1].vertices[i], palette, palette, 0);
    EXPECT_LT((found - expected).norm(), 1e-5F) << "vertex " << i;
  }
}

TEST_F(GlbTest, WritingIsRepeatable) {
  EXPECT_EQ(encode_glb(made_up_asset()), encode_glb(made_up_asset()));
}

TEST_F(GlbTest, AFileThatIsNoGlbIsNamedInTheError) {
  const fs::path path = write("this is not a model");
  try {
    read_glb(path);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("made_up.glb"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("throng people build"), std::string::npos);
  }
}

TEST_F(GlbTest, ACutFileIsAnErrorNotACrash) {
  const std::string whole = encode_glb(made_up_asset());
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{11}, whole.size() / 4, whole.size() / 2, whole.size() - 1000}) {
    EXPECT_THROW(read_glb(write(whole.substr(0, size))), InputError) << size;
  }
}

TEST_F(GlbTest, AnUnknownBoneIsNamed) {
  std::string bytes = encode_glb(made_up_asset());
  const std::size_t at = bytes.find("\"left_shin\"");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 11, "\"left_tail\"");
  try {
    read_glb(write(bytes));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("left_"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace throng::skinning
