// Any job: it is refused, or is the same job again when it is written and read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"
#include "fuzz_folder.h"
#include "jobs/spec/spec.h"
#include "tests/jobs/yard.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const throng::crowd::fuzz::Folder folder;
  static const std::filesystem::path scenarios = [] {
    const std::filesystem::path place = folder.write("yard.json", "").parent_path();
    throng::jobs::write_yard(place);
    return place;
  }();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string written;
  try {
    written = to_json(throng::jobs::parse_job(text, "", scenarios)).dump();
  } catch (const throng::InputError&) {
    return 0;
  } catch (const throng::EnvironmentError&) {
    return 0;
  }
  // What was accepted must be accepted again.
  if (to_json(throng::jobs::parse_job(written, "", scenarios)).dump() != written) std::abort();
  return 0;
}
