// Any scene and behavior, then a few steps. An input is a scene, "=====", a byte that chooses the
// model and the other options, and a behavior.
#include <cstddef>
#include <cstdint>

#include "crowd/state/model.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_steps.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng::crowd;
  static const fuzz::Folder folder;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  constexpr std::string_view kSeparator = "=====";
  const std::size_t middle = input.find(kSeparator);
  if (middle == std::string_view::npos || fuzz::is_crowded(input)) return 0;
  const std::size_t after = middle + kSeparator.size();
  if (after == size) return 0;
  LoadOptions options;
  const std::size_t choice = data[after];
  options.model = models()[choice % models().size()].name;
  options.compat = static_cast<Compat>(choice / 32 % 3);
  options.separation = choice / 96 % 2 == 1 ? BodySeparation::hard : BodySeparation::soft;
  // The files that corpus inputs refer to.
  folder.write("map.txt", "2\n1 0 0\n1 9 0\n1\n0 1\n");
  folder.write("field.txt", "2 2\n8\n-8 -8\n1 0\n0 1\n1 0\n0 1\n");
  fuzz::load_and_step(folder.write("scene.xml", input.substr(0, middle)),
                      folder.write("behavior.xml", input.substr(after + 1)), options);
  return 0;
}
