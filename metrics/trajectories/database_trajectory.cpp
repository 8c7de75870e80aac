// JuPedSim's SQLite database of trajectories.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <cerrno>
#include <cmath>

#include "base/error.h"
#include "base/files/files.h"
#include "base/resource_exhaustion.h"
#include "metrics/trajectories/database_trajectory.h"
#include "metrics/trajectories/other_formats.h"

namespace throng::metrics {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kMaxDatabaseFrame = 10'000'000;

void add_metadata(SQLite::Database& database, const char* key, const std::string& value) {
  SQLite::Statement metadata(database, "INSERT INTO metadata VALUES (?, ?)");
  metadata.bind(1, key);
  metadata.bind(2, value);
  metadata.exec();
}

// The only geometry: JuPedSim's numbers are hashes, which nobody compares with another's.
constexpr std::int64_t kGeometryHash = 1;

void add_geometry(const world::Trace& trace, const std::string& walkable,
                  SQLite::Database& database) {
  SQLite::Statement geometry(database, "INSERT INTO geometry (hash, wkt) VALUES (?, ?)");
  geometry.bind(1, kGeometryHash);
  geometry.bind(2, walkable);
  geometry.exec();
  SQLite::Statement frame(database, "INSERT INTO frame_data VALUES (?, ?)");
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    frame.bind(1, static_cast<std::int64_t>(step));
    frame.bind(2, kGeometryHash);
    frame.exec();
    frame.reset();
  }
}

// As JuPedSim 1.x writes it, version 2.
void fill_database(const world::Trace& trace, const std::string& walkable,
                   SQLite::Database& database) {
  SQLite::Transaction transaction(database);
  database.exec(
      "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT "
      "NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);"
      "CREATE TABLE metadata (key TEXT NOT NULL UNIQUE, value TEXT NOT NULL);"
      "CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
      "CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
      "CREATE INDEX frame_id_idx ON trajectory_data (frame, id)");
  add_metadata(database, "version", "2");
  add_metadata(database, "fps", fmt::format("{}", 1 / trace.header.dt_s));
  if (!walkable.empty()) add_geometry(trace, walkable, database);
  SQLite::Statement row(database, "INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)");
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
      if (trace.header.role[agent] != world::AgentRole::person || !trace.present(step, agent)) {
        continue;
      }
      const std::size_t at = trace.at(step, agent);
      row.bind(1, static_cast<std::int64_t>(step));
      row.bind(2, static_cast<std::int64_t>(agent) + 1);
      row.bind(3, trace.position[at].x());
      row.bind(4, trace.position[at].y());
      row.bind(5, std::cos(trace.yaw_rad[at]));
      row.bind(6, std::sin(trace.yaw_rad[at]));
      row.exec();
      row.reset();
    }
  }
  transaction.commit();
}

}  // namespace

Recorded read_database(const fs::path& file, std::optional<double> frames_per_s) {
  try {
    const SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
    Recorded recorded;
    recorded.unit_is_stated = true;
    SQLite::Statement rate(database, "SELECT value FROM metadata WHERE key = 'fps'");
    if (rate.executeStep()) recorded.frames_per_s = rate.getColumn(0).getDouble();
    if (frames_per_s) recorded.frames_per_s = *frames_per_s;
    if (!(recorded.frames_per_s > 0)) {
      throw InputError({file.string(), "table metadata", "no fps", kFrameRateExpected});
    }
    SQLite::Statement rows(database, "SELECT id, frame, pos_x, pos_y FROM trajectory_data");
    while (rows.executeStep()) {
      const std::int64_t frame = rows.getColumn(1).getInt64();
      const auto place = recorded.places[rows.getColumn(0).getInt64()].try_emplace(
          frame, rows.getColumn(2).getDouble(), rows.getColumn(3).getDouble());
      if (!place.second || frame > kMaxDatabaseFrame || frame < -kMaxDatabaseFrame) {
        throw InputError({file.string(), "table trajectory_data", fmt::format("frame {}", frame),
                          "frames within 10 million, each person once a frame"});
      }
    }
    return recorded;
  } catch (const SQLite::Exception& error) {
    throw InputError({file.string(), "", error.what(),
                      "a database of JuPedSim: tables trajectory_data and metadata"});
  }
}

void write_database(const world::Trace& trace, const std::string& walkable, const fs::path& file) {
  try {
    StagedFile staged(file);
    {
      SQLite::Database database(staged.path().string(),
                                SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
      fill_database(trace, walkable, database);
    }
    staged.commit();
  } catch (const SQLite::Exception& error) {
    constexpr int kFull = 13;  // SQLITE_FULL
    if (error.getErrorCode() == kFull) throw_write_error(file, ENOSPC);
    throw EnvironmentError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace throng::metrics
