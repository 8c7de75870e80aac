// Small readers and choices that exports and checks are made of: arrays, tables, masks,
// comparisons, splits and classes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "annotate/rasters/png.h"
#include "base/error.h"
#include "base/files/zip_member.h"
#include "formats/dataset/comparison.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/raster_files.h"
#include "formats/files/csv_table.h"
#include "formats/files/npy.h"
#include "tests/formats/hand_made.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using throng::testing::TemporaryFolder;

/// The message of the error that a call throws; "accepted" if it throws none.
template <typename Call>
std::string refused(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string npy(const std::string& header, const std::vector<float>& values,
                const std::string& magic = std::string("\x93NUMPY\x01\x00", 8)) {
  std::string padded = header;
  padded.resize(118, ' ');
  std::string bytes = magic + static_cast<char>(118) + '\0' + padded;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  return bytes;
}

TEST(NpyFiles, AreFloatsInRows) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.npy";
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
  write_file_atomically(file, npy(header, {1, 2, 3, 4, 5, 6}));
  const FloatMap map = read_npy(file);
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.height, 2);
  EXPECT_THAT(map.value, ElementsAre(1, 2, 3, 4, 5, 6));
  const auto expect = [&](const std::string& words, const std::string& bytes) {
    write_file_atomically(file, bytes);
    EXPECT_THAT(refused([&] { read_npy(file); }), HasSubstr(words));
  };
  expect("another length", npy(header, {1, 2, 3, 4, 5}));
  expect("another length", npy(header, {1, 2, 3, 4, 5, 6, 7}));
  expect("another header",
         npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", {1, 2, 3, 4, 5, 6}));
  expect("another header",
         npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), }", {1, 2, 3, 4, 5, 6}));
  expect("another header",
         npy("{'descr': '<f4', 'fortran_order': False, 'shape': (6,), }", {1, 2, 3, 4, 5, 6}));
  expect("another kind of file", npy(header, {1}, std::string("\x93NUMPY\x02\x00", 8)));
  expect("another kind of file", "NUMPY");
  fs::remove(file);
  EXPECT_THAT(refused([&] { read_npy(file); }), HasSubstr("no such file"));
}

TEST(Npz, HoldsAnArrayOfItsOwnName) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.npz";
  const std::string inside =
      npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", {1, 2, 3, 4, 5, 6});
  write_file_atomically(file, make_zip("density.npy", inside));
  EXPECT_THAT(read_npy(file).value, ElementsAre(1, 2, 3, 4, 5, 6));
  const auto expect = [&](const std::string& words, const std::string& bytes) {
    write_file_atomically(file, bytes);
    EXPECT_THAT(refused([&] { read_npy(file); }), AllOf(HasSubstr(words), HasSubstr("a.npz")));
  };
  expect("no member \"density.npy\"", make_zip("depth.npy", inside));
  expect("of more than", make_zip("density.npy", std::string(200'000'000, 0)));
  expect("found ", make_zip("density.npy", inside).substr(0, 60));
  expect("found ", inside);
}

TEST(Rasters, KeepTheirSamples) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.png";
  write_file_atomically(
      file, annotate::png_bytes({2, 1, 3}, std::vector<std::uint16_t>{1, 256, 65535, 40, 50, 60}));
  const images::Raster wide = images::read_raster(file);
  EXPECT_EQ(wide.bits, 16);
  EXPECT_EQ(wide.channels, 3);
  EXPECT_EQ(wide.width, 2);
  EXPECT_THAT(wide.samples, ElementsAre(1, 256, 65535, 40, 50, 60));
  EXPECT_THAT(refused([&] { read_instances(file, 2, 1); }), HasSubstr("a.png")) << "not of 8 bits";
  write_file_atomically(file, "no image");
  EXPECT_THAT(refused([&] { images::read_raster(file); }), HasSubstr("a.png"));
  EXPECT_EQ(raster_path("/d", "depth", "images/a/b.jpg"), fs::path("/d/depth/a/b.png"));
}

TEST(CsvTables, HaveQuotesAndEqualRows) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "t.csv";
  const auto read = [&](const std::string& text) {
    write_file_atomically(file, text);
    return read_csv(file);
  };
  const CsvTable table = read("a,b,c\r\n1,\"x, \"\"y\"\"\",\r\n,,3\n");
  EXPECT_THAT(table.columns, ElementsAre("a", "b", "c"));
  ASSERT_EQ(table.rows.size(), 2);
  EXPECT_THAT(table.rows[0], ElementsAre("1", "x, \"y\"", ""));
  EXPECT_THAT(table.rows[1], ElementsAre("", "", "3"));
  EXPECT_EQ(table.find("c"), 2);
  EXPECT_EQ(table.find("d"), 3);
  EXPECT_THAT(refused([&] { read("a,b\n1,2\n3\n"); }),
              ::testing::AllOf(HasSubstr("line 3"), HasSubstr("1 cells"), HasSubstr("2 cells")));
  EXPECT_THAT(refused([&] { read(""); }), HasSubstr("t.csv"));
  EXPECT_EQ(parse_number("-1.5e2"), -150);
  for (const char* text : {"", "x", "1x", "1 "})
    EXPECT_TRUE(std::isnan(parse_number(text))) << text;
}

TEST(Masks, RunDownColumns) {
  // Image of 4 x 3; the pixels (1, 1), (1, 2) and (2, 0) are set: positions 4, 5 and 6.
  const std::vector<std::uint32_t> runs = {4, 3, 5};
  EXPECT_EQ(decode_runs(encode_counts(runs), 12), runs);
  const Bitmap mask = decode_bitmap(runs, 3);
  EXPECT_EQ(mask.x, 1);
  EXPECT_EQ(mask.y, 0);
  EXPECT_EQ(mask.width, 2);
  EXPECT_EQ(mask.height, 3);
  EXPECT_EQ(mask.area(), 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(mask.at(x, y), (x == 1 && y > 0) || (x == 2 && y == 0)) << x << " " << y;
    }
  }
  EXPECT_FALSE(mask.at(-1, 0));
  EXPECT_FALSE(mask.at(4, 9));
  EXPECT_EQ(decode_bitmap({12}, 3).width, 0) << "an empty one";
  EXPECT_EQ(decode_bitmap({0, 12}, 3).area(), 12);
}

TEST(Masks, HaveCocosCompressedCounts) {
  // Computed by pycocotools' rule: from the fourth run on the difference to the run two before,
  // five bits a character from '0', the sixth says that more follow, the fifth of the last is the
  // sign. 4, 3, 5: "4", "3", "5". 4, 3, 5, 2: the fourth is 2 - 3 = -1, 31 without more: 'O'.
  EXPECT_EQ(encode_counts({4, 3, 5}), "435");
  EXPECT_EQ(encode_counts({4, 3, 5, 2}), "435O");
  // 16 has the sign's bit set, so that it takes two characters: 16 + 32 = '`', then '0'.
  EXPECT_EQ(encode_counts({16}), "`0");
  EXPECT_EQ(decode_runs("`0", 16), (std::vector<std::uint32_t>{16}));
  EXPECT_THAT(refused([] { decode_runs("435O", 15); }), HasSubstr("runs that fill the image"));
  EXPECT_THAT(refused([] { decode_runs("`", 16); }), HasSubstr("whole numbers"));
  EXPECT_THAT(refused([] { decode_runs("O", 16); }), HasSubstr("runs of positive length"));
}

TEST(Masks, TakePartsOfColumns) {
  // Image of 3 x 4; a run over the end of the first column: (0, 3), (1, 0) and (1, 1).
  const Bitmap mask = decode_bitmap({3, 3, 6}, 4);
  EXPECT_EQ(mask.x, 0);
  EXPECT_EQ(mask.width, 2);
  EXPECT_EQ(mask.height, 4);
  EXPECT_TRUE(mask.at(0, 3));
  EXPECT_TRUE(mask.at(1, 0));
  EXPECT_TRUE(mask.at(1, 1));
  EXPECT_FALSE(mask.at(0, 2));
  EXPECT_FALSE(mask.at(1, 2));
  EXPECT_EQ(mask.area(), 3);
  EXPECT_EQ(union_runs({mask}, 3, 4), (std::vector<std::uint32_t>{3, 3, 6})) << "and back";
}

TEST(Masks, AreJoined) {
  const Bitmap a{0, 0, 2, 1, {1, 1}};
  const Bitmap b{1, 0, 2, 1, {1, 0}};
  const Bitmap c{3, 2, 1, 1, {1}};
  EXPECT_EQ(union_runs({a, b, c}, 4, 3), (std::vector<std::uint32_t>{0, 1, 2, 1, 7, 1}));
  EXPECT_EQ(union_runs(std::vector<Bitmap>{}, 4, 3), (std::vector<std::uint32_t>{12}));
}

TEST(Comparisons, NameDifferentMissingAndSurplusFiles) {
  const TemporaryFolder scratch;
  const fs::path folder = scratch.path() / "there";
  const fs::path made = scratch.path() / "made";
  write_file_atomically(folder / "same.txt", "abc");
  write_file_atomically(folder / "other.txt", "abd");
  write_file_atomically(folder / "sub/more.txt", "x");
  write_file_atomically(folder / "image.jpg", std::string(100'000, 'p'));
  write_file_atomically(made / "good.jpg", std::string(100'000, 'p'));
  write_file_atomically(made / "bad.jpg", std::string(99'999, 'p') + "q");
  std::vector<std::string> reports;
  Comparison comparison(folder, [&](const std::string& path, const std::string& what) {
    reports.push_back(path + ": " + what);
  });
  comparison.bytes("same.txt", "abc");
  comparison.file("image.jpg", made / "good.jpg");
  EXPECT_THAT(reports, ::testing::IsEmpty());
  comparison.bytes("other.txt", "abc");
  comparison.bytes("gone.txt", "abc");
  comparison.file("image.jpg", made / "bad.jpg");
  comparison.finish();
  EXPECT_THAT(reports, ElementsAre("other.txt: not what the annotations give",
                                   "gone.txt: no such file, but the annotations give one",
                                   "image.jpg: not what the annotations or images give",
                                   "sub/more.txt: a file that the format does not have"));
}

TEST(SplitShares, RoundToWholeRuns) {
  const auto splits = [](std::array<double, 3> share, std::size_t runs) {
    DatasetInfo info = hand_made::info("/x");
    info.runs.clear();
    for (std::size_t i = 0; i < runs; ++i) info.runs.push_back("run00" + std::to_string(i));
    info.options.splits.share = share;
    std::string text;
    for (const std::string& run : info.runs) text += to_string(info.split_of(run))[1];
    return text;
  };
  // r: train, a: val, e: test.
  EXPECT_EQ(splits({0.7, 0.2, 0.1}, 9), "rrrrrraae") << "6.3, 8.1 and 9 round to 6, 8 and 9";
  EXPECT_EQ(splits({0.7, 0.2, 0.1}, 8), "rrrrrrae") << "5.6 and 7.2 round to 6 and 7";
  EXPECT_EQ(splits({0.5, 0.5, 0}, 4), "rraa");
  EXPECT_EQ(splits({1, 1, 0}, 4), "rraa") << "scaled";
  EXPECT_EQ(splits({0, 0, 1}, 2), "ee");
  EXPECT_EQ(splits({1, 0, 0}, 3), "rrr");
}

TEST(SplitShares, LeaveRunsThatAreNamedAlone) {
  DatasetInfo info = hand_made::info("/x");
  info.options.splits.share = {0.5, 0.5, 0};
  info.options.splits.runs = {{"run000", Split::test}};
  EXPECT_EQ(info.split_of("run000"), Split::test);
  EXPECT_EQ(info.split_of("run001"), Split::train) << "the first of two others";
  EXPECT_EQ(info.split_of("run002"), Split::val);
  EXPECT_THAT(info.splits(), ElementsAre(Split::train, Split::val, Split::test));
}

TEST(ClassNames, AreValuesOfTheirProperty) {
  ClassOptions classes;
  classes.by = "sex";
  add_class_name("female=woman", "--class-name", classes);
  EXPECT_EQ(classes.names.at("female"), "woman");
  for (const char* text : {"female", "female=", "other=x", "=x", ""}) {
    EXPECT_THAT(refused([&] { add_class_name(text, "--class-name", classes); }),
                ::testing::AllOf(HasSubstr("--class-name"), HasSubstr("female, male")))
        << text;
  }
  EXPECT_THAT(class_values("age_band"), ElementsAre("child", "teenager", "adult", "senior"));
  EXPECT_THAT(class_values("height"), ::testing::IsEmpty());
  for (const std::string_view property : class_properties()) {
    EXPECT_FALSE(class_values(property).empty()) << property;
  }
}

TEST(PixelsAcross, AreFocalLengthsPerDistance) {
  const Image image = hand_made::image();
  const camera::Camera camera = image_camera(image);
  // 50 px of focal length, 0.4 m at 20 m.
  EXPECT_NEAR(pixels_across(camera, {0, 20, 1}, 0.4), 1, 1e-9);
  EXPECT_NEAR(pixels_across(camera, {7, 40, 1}, 0.4), 0.5, 1e-9) << "by depth, not by distance";
  EXPECT_NEAR(pixels_across(camera, {0, -5, 1}, 0.4), 200, 1e-9) << "10 cm at least";
}

TEST(CameraOf, HasTheLensOfTheRecord) {
  Image image = hand_made::image();
  EXPECT_FALSE(image_camera(image).intrinsics.distortion);
  image.record["camera"] = {
      {"model", "brown_conrady"},
      {"distortion", {{"k1", 1}, {"k2", 2}, {"p1", 3}, {"p2", 4}, {"k3", 5}}}};
  const auto brown = image_camera(image).intrinsics.distortion;
  EXPECT_THAT(brown->coefficients(), ElementsAre(1, 2, 3, 4, 5, 0, 0, 0)) << "OpenCV's order";
  image.record["camera"] = {{"model", "fisheye"},
                            {"distortion", {{"k1", 1}, {"k2", 2}, {"k3", 3}, {"k4", 4}}}};
  const auto lens = image_camera(image).intrinsics.distortion;
  EXPECT_EQ(lens->model(), camera::Distortion::Model::fisheye);
  EXPECT_THAT(std::vector<double>(lens->coefficients().begin(), lens->coefficients().begin() + 4),
              ElementsAre(1, 2, 3, 4));
}

TEST(Manifests, AreThoseOfFinishedDatasets) {
  const TemporaryFolder folder;
  EXPECT_NE(refused([&] { read_manifest(folder.path()); }), "accepted");
  write_file_atomically(folder.path() / "manifest.json", "{");
  EXPECT_NE(refused([&] { read_manifest(folder.path()); }), "accepted");
}

}  // namespace
}  // namespace throng::formats
