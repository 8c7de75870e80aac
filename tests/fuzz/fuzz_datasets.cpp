// Any manifest and labels of a dataset: what reads, joins, exports or publishes it refuses them or
// stays within its folders. An input is manifest.json, "=====", and annotations/instances.json.
#include <sys/stat.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/error.h"
#include "base/files/files.h"
#include "checks/validate.h"
#include "formats/export/exporter.h"
#include "formats/merge.h"
#include "jobs/queue/dataset/manifest.h"
#include "tests/fuzz/fuzz_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace throng;

constexpr const char* kSecret = "beside.jpg";

/// Runs a reader of the dataset; errors of input and machine are what it may throw.
template <typename Action>
void attempt(const Action& action) {
  try {
    action();
  } catch (const InputError&) {
  } catch (const EnvironmentError&) {
  }
}

/// Aborts if anything was written outside of the dataset and the outputs, or the file beside them
/// was linked into these.
void require_undisturbed(const fs::path& outer) {
  for (const auto& entry : fs::directory_iterator(outer)) {
    const std::string name = entry.path().filename();
    if (name != kSecret && name != "inner") std::abort();
  }
  for (const auto& entry : fs::directory_iterator(outer / "inner")) {
    const std::string name = entry.path().filename();
    if (name != "dataset" && !name.starts_with("out")) std::abort();
  }
  struct stat status {};
  if (::stat((outer / kSecret).c_str(), &status) != 0 || status.st_nlink != 1) std::abort();
}

void export_all(const fs::path& dataset, const fs::path& output) {
  const nlohmann::json manifest = formats::read_manifest(dataset);
  const formats::DatasetInfo info =
      formats::describe_dataset(dataset, manifest, formats::export_options(dataset, manifest));
  for (const formats::Format& format : formats::all_formats()) {
    attempt([&] { formats::export_dataset(info, {&format}, output); });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowd::fuzz::Folder folder;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  constexpr std::string_view kSeparator = "=====";
  const std::size_t middle = input.find(kSeparator);
  if (middle == std::string_view::npos) return 0;
  const fs::path outer = folder.write(kSecret, "secret").parent_path();
  const fs::path dataset = outer / "inner/dataset";
  for (const char* path : {"images/run000/d1/000000.jpg", "instances/run000/d1/000000.png"}) {
    make_folders((dataset / path).parent_path());
    write_temporary_file(dataset / path, "no image");
  }
  make_folders(dataset / "annotations");
  write_temporary_file(dataset / "manifest.json", input.substr(0, middle));
  write_temporary_file(dataset / "annotations/instances.json",
                       input.substr(middle + kSeparator.size()));
  write_temporary_file(dataset / "metrics.json", R"({"runs":[{"run":"run000"}]})");
  attempt([&] { static_cast<void>(jobs::read_manifest(dataset)); });
  attempt([&] { static_cast<void>(checks::validate_dataset(dataset)); });
  attempt([&] { export_all(dataset, outer / "inner/out-formats"); });
  attempt([&] { formats::merge_datasets({dataset, dataset}, outer / "inner/out-merged"); });
  require_undisturbed(outer);
  fs::remove_all(outer / "inner");
  return 0;
}
