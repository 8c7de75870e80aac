// throng schema: the JSON Schemas of files, for editors, and the description of the HTTP API.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/suggest.h"
#include "cli/shell/commands.h"
#include "server/routes/openapi_text.h"
#include "spec/documents/published_schemas.h"

namespace throng::cli {

namespace {

constexpr std::string_view kApi = "openapi";

struct SchemaArguments {
  std::string name;
  std::string folder;
};

void print_schema(const SchemaArguments& arguments) {
  std::vector<std::string_view> names = jobs::schema_names();
  if (!arguments.folder.empty()) {
    for (const std::string_view name : names) {
      const auto file =
          std::filesystem::path(arguments.folder) / (std::string(name) + ".schema.json");
      write_file_atomically(file, jobs::published_schema(name));
      fmt::print("{}\n", file.string());
    }
    return;
  }
  if (arguments.name.empty()) {
    for (const std::string_view name : names) fmt::print("{}\n", name);
    return;
  }
  const std::string text =
      arguments.name == kApi ? server::openapi_text() : jobs::published_schema(arguments.name);
  if (text.empty()) {
    names.push_back(kApi);
    throw InputError(unknown_name("", "schema", "schema", arguments.name, names));
  }
  fmt::print("{}", text);
}

}  // namespace

void add_schema(CLI::App& app) {
  auto* command =
      app.add_subcommand("schema", "Print the JSON Schema of a kind of file, for editors");
  const auto arguments = std::make_shared<SchemaArguments>();
  command->add_option("name", arguments->name,
                      "Kind of file, or openapi for the HTTP API; without it, list the kinds");
  command->add_option("-o,--output", arguments->folder,
                      "Folder to write all of them to, as NAME.schema.json");
  command->callback([arguments] { print_schema(*arguments); });
}

}  // namespace throng::cli
