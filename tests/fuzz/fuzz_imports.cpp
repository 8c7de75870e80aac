// Worlds, maps and trajectories of others. The first line of an input names the kind (sdf, osm,
// text, csv, times, sqlite, scb); the rest is the file. Readable input becomes a scenario.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "base/error.h"
#include "metrics/trajectories/trajectory_file.h"
#include "places/imports/imports.h"
#include "tests/fuzz/fuzz_folder.h"

namespace throng::imports::fuzz {
namespace {

void read_trajectory(const std::filesystem::path& file, std::string_view kind) {
  metrics::TrajectoryFormat format;
  if (kind == "text") format.kind = metrics::TrajectoryKind::text;
  if (kind == "sqlite") format.kind = metrics::TrajectoryKind::sqlite;
  if (kind == "scb") format.kind = metrics::TrajectoryKind::scb;
  if (kind == "csv" || kind == "times") format.kind = metrics::TrajectoryKind::csv;
  if (kind == "csv") format.frames_per_s = 10;
  if (kind == "times") format.columns.time = "t";
  std::vector<Problem> notes;
  metrics::read_trajectory(file, {}, format, &notes);
}

void read(std::string_view kind, const crowd::fuzz::Folder& folder, std::string_view text) {
  if (kind != "sdf" && kind != "osm") {
    return read_trajectory(folder.write("walk", text), kind);
  }
  // A small one: the fuzzer's time is for the readers.
  ImportedScenario place = kind == "sdf" ? read_sdf(folder.write("w.sdf", text), {})
                                         : read_osm(folder.write("m.osm", text), {});
  constexpr double kMaxSizeM = 300;
  if ((place.inside.max - place.inside.min).maxCoeff() < kMaxSizeM) populate(place, {5, 1});
}

}  // namespace
}  // namespace throng::imports::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const throng::crowd::fuzz::Folder folder;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = input.find('\n');
  if (line == std::string_view::npos) return 0;
  const bool say = std::getenv("THRONG_FUZZ_SAY") != nullptr;
  try {
    throng::imports::fuzz::read(input.substr(0, line), folder, input.substr(line + 1));
    if (say) fmt::print(stderr, "read\n");
  } catch (const throng::InputError& error) {
    if (say) fmt::print(stderr, "{}\n", error.what());
  } catch (const throng::EnvironmentError& error) {
    if (say) fmt::print(stderr, "{}\n", error.what());
  }
  return 0;
}
