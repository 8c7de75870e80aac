// throng people sheet: renders an overview of a character library.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <numeric>
#include <vector>

#include "annotate/people_sheet/people_sheet.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/images/jpeg_writer.h"
#include "base/text/words.h"
#include "cli/shell/commands.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "skinning/image.h"
#include "skinning/population.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;

constexpr int kMinWidthPx = 800;
constexpr int kMaxWidthPx = 8000;

struct SheetArguments {
  std::string folder;
  std::string output;
  std::vector<std::string> people;
  int count = 24;
  std::uint64_t seed = 1;
  int width_px = 2400;
};

std::string lower_extension(const fs::path& file) { return lower_case(file.extension().string()); }

// All input is checked before anything is rendered.
void check_arguments(const SheetArguments& arguments) {
  const std::string extension = lower_extension(arguments.output);
  if (extension != ".png" && extension != ".jpg" && extension != ".jpeg") {
    throw InputError({arguments.output, "people sheet: --output",
                      extension.empty() ? "no extension" : extension, ".png, .jpg or .jpeg"});
  }
  const fs::path parent = fs::absolute(arguments.output).parent_path();
  if (fs::is_directory(arguments.output)) {
    throw InputError({arguments.output, "people sheet: --output", "a folder", "a file to write"});
  }
  if (!fs::is_directory(parent) || ::access(parent.c_str(), W_OK) != 0) {
    throw InputError({arguments.output, "people sheet: --output",
                      fs::is_directory(parent) ? "a folder that cannot be written"
                                               : fmt::format("no folder {}", parent.string()),
                      "a file in a folder that is there and can be written"});
  }
  if (arguments.count < 1) {
    throw InputError({"", "people sheet: --count", std::to_string(arguments.count), "at least 1"});
  }
  if (arguments.width_px < kMinWidthPx || arguments.width_px > kMaxWidthPx) {
    throw InputError({"", "people sheet: --width", std::to_string(arguments.width_px),
                      fmt::format("{} to {} pixels", kMinWidthPx, kMaxWidthPx)});
  }
}

std::uint32_t find(const skinning::Population& population, const std::string& name) {
  const auto found =
      std::find_if(population.characters.begin(), population.characters.end(),
                   [&](const skinning::Character& character) { return character.name == name; });
  if (found == population.characters.end()) {
    throw InputError({"", "people sheet: --people", name, "a name of `throng people list`"});
  }
  return static_cast<std::uint32_t>(found - population.characters.begin());
}

annotate::SheetOptions read_options(const SheetArguments& arguments,
                                    const skinning::Population& population) {
  annotate::SheetOptions options;
  options.seed = arguments.seed;
  options.width_px = arguments.width_px;
  for (const std::string& name : arguments.people) {
    options.portraits.push_back(find(population, name));
  }
  if (arguments.people.empty()) {
    options.crowd.resize(population.characters.size());
    std::iota(options.crowd.begin(), options.crowd.end(), 0);
    options.portraits = options.crowd;
    const auto count = static_cast<std::size_t>(arguments.count);
    options.portraits.resize(std::min(count, options.portraits.size()));
  } else {
    options.crowd = options.portraits;
  }
  return options;
}

std::string sheet_encoded(const annotate::Sheet& sheet, const std::string& extension) {
  constexpr int kQuality = 82;
  if (extension != ".png") {
    return images::jpeg_bytes(sheet.rgb, sheet.width, sheet.height, kQuality);
  }
  skinning::Image image(sheet.width, sheet.height);
  for (std::size_t i = 0; 3 * i < sheet.rgb.size(); ++i) {
    std::copy_n(sheet.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
    image.rgba[4 * i + 3] = 255;
  }
  return images::encode_png(image);
}

void draw(const SheetArguments& arguments) {
  check_arguments(arguments);
  const Interrupt interrupt;
  ProgressBar bar("drawing the sheet");
  const skinning::Population population = skinning::load_population(arguments.folder);
  const annotate::Sheet sheet = annotate::draw_people_sheet(
      population, read_options(arguments, population), [&](double share, std::string_view what) {
        if (interrupt.token().stop_requested()) throw Cancelled();
        bar.show(share, what);
      });
  if (interrupt.token().stop_requested()) throw Cancelled();
  write_file_atomically(arguments.output, sheet_encoded(sheet, lower_extension(arguments.output)));
  bar.show(1, fmt::format("{} x {} pixels", sheet.width, sheet.height));
}

}  // namespace

void add_people_sheet(CLI::App& people) {
  auto* command = people.add_subcommand(
      "sheet", "Render an overview of a character library: near, far, in motion, and body heights");
  const auto arguments = std::make_shared<SheetArguments>();
  arguments->folder = skinning::population_folder().string();
  command->add_option("folder", arguments->folder, "Folder of the character library")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Image to write: .png or .jpg")->required();
  auto* names = command->add_option("--people", arguments->people,
                                    "Only these characters, by name, separated by commas");
  names->delimiter(',');
  command->add_option("--count", arguments->count, "Number of characters, from the first on")
      ->capture_default_str()
      ->excludes(names);
  command->add_option("--seed", arguments->seed, "Seed of colors, of the crowd and of the heights")
      ->capture_default_str();
  command->add_option("--width", arguments->width_px, "Pixels across, 800 to 8000")
      ->capture_default_str();
  command->callback([arguments] { draw(*arguments); });
}

}  // namespace throng::cli
