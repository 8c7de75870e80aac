// Trajectories in databases: Jülich's HDF5, and the walkable area of JuPedSim's SQLite.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include "base/error.h"
#include "metrics/trajectories/trajectory_file.h"
#include "tests/metrics/walks.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

struct ArchiveRow {
  std::int64_t id;
  std::int64_t frame;
  double x;
  double y;
  double z;
};

/// Writes a file as the Pedestrian Dynamics Data Archive has them.
std::filesystem::path write_archive(const TemporaryFolder& folder, const char* dataset_name,
                                    std::optional<double> fps, const std::string& unit) {
  const std::vector<ArchiveRow> rows = {
      {4, 10, 100, 200, 0}, {4, 11, 150, 200, 0}, {7, 11, 300, 200, 0}};
  const std::filesystem::path path = folder.path() / "walk.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(ArchiveRow));
  H5Tinsert(type, "id", HOFFSET(ArchiveRow, id), H5T_NATIVE_INT64);
  H5Tinsert(type, "frame", HOFFSET(ArchiveRow, frame), H5T_NATIVE_INT64);
  H5Tinsert(type, "x", HOFFSET(ArchiveRow, x), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "y", HOFFSET(ArchiveRow, y), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "z", HOFFSET(ArchiveRow, z), H5T_NATIVE_DOUBLE);
  const hsize_t count = rows.size();
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t data =
      H5Dcreate2(file, dataset_name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data());
  const hid_t one = H5Screate(H5S_SCALAR);
  if (fps) {
    const hid_t rate = H5Acreate2(data, "fps", H5T_NATIVE_DOUBLE, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(rate, H5T_NATIVE_DOUBLE, &*fps);
    H5Aclose(rate);
  }
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, H5T_VARIABLE);
  const char* words = unit.c_str();
  const hid_t note = H5Acreate2(data, "x", text, one, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(note, text, static_cast<const void*>(&words));
  H5Aclose(note);
  H5Tclose(text);
  H5Sclose(one);
  H5Dclose(data);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(file);
  return path;
}

TEST(TrajectoryDatabases, ReadTheHdf5OfTheDataArchive) {
  const TemporaryFolder folder;
  const world::Trace trace = read_trajectory(
      write_archive(folder, "trajectory", 25, "pedestrian x-coordinate (centimeter [cm])"), {});
  ASSERT_EQ(trace.agents(), 2U);
  ASSERT_EQ(trace.steps(), 2U);
  EXPECT_NEAR(trace.header.dt_s, 0.04, 1e-9);
  EXPECT_NEAR(trace.position[trace.at(1, 0)].x(), 1.5, 1e-6);
  EXPECT_FALSE(trace.present(0, 1));
  for (const char* feet : {"x-coordinate (foot [ft])", "ft", "x-coordinate in feet"}) {
    EXPECT_NEAR(read_trajectory(write_archive(folder, "trajectory", 25, feet), {}).position[0].x(),
                100 * 0.3048, 1e-4)
        << feet;
  }
}

std::string refusal(const std::filesystem::path& file) {
  try {
    read_trajectory(file, {});
  } catch (const InputError& error) {
    return error.problems().at(0).text();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(TrajectoryDatabases, SayWhatAnHdf5FileLacks) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(write_archive(folder, "trajectory", std::nullopt, "m")),
              HasSubstr("--frame-rate"));
  EXPECT_THAT(refusal(write_archive(folder, "walks", 25, "m")), HasSubstr("\"trajectory\""));
  EXPECT_THAT(refusal(write_archive(folder, "trajectory", 25, "column [px]")),
              HasSubstr("length of a pixel"));
}

std::vector<std::string> geometries(const std::filesystem::path& file) {
  const SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
  // As PedPy's loader asks for them.
  SQLite::Statement rows(database, "SELECT wkt FROM geometry");
  std::vector<std::string> all;
  while (rows.executeStep()) all.push_back(rows.getColumn(0).getString());
  SQLite::Statement frames(database,
                           "SELECT count(*) FROM frame_data JOIN geometry ON geometry_hash = hash");
  EXPECT_TRUE(frames.executeStep());
  EXPECT_GT(frames.getColumn(0).getInt(), 1);
  return all;
}

TEST(TrajectoryDatabases, HaveTheWalkableArea) {
  std::vector<Walk> walks = {walking({-2, 0}, {1, 0})};
  world::Trace trace = make_trace(walks);
  trace.header.exit_ids.clear();
  const TemporaryFolder folder;
  world::Scenario scenario = place_with_door(2);
  scenario.ground = {{-20, -10}, {30, 10}};
  world::Building house;
  house.footprint = {{-10, 5}, {-8, 5}, {-8, 6}, {-10, 6}};
  scenario.buildings = {house};
  const auto file = folder.path() / "walk.sqlite";
  write_trajectory(trace, file, &scenario);
  const std::vector<std::string> all = geometries(file);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all[0], ::testing::StartsWith("POLYGON (("));
  EXPECT_THAT(all[0], HasSubstr("-20 -10"));
  EXPECT_THAT(all[0], HasSubstr("), ("));
  EXPECT_THAT(all[0], HasSubstr("-8 5"));
  write_trajectory(trace, file);
  ASSERT_EQ(geometries(file).size(), 1U);
  EXPECT_THAT(geometries(file)[0], HasSubstr("(-3 -1")) << "the box around people, with 1 m";
}

}  // namespace
}  // namespace throng::metrics
