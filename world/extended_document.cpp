#include "world/extended_document.h"

#include <fmt/core.h>

#include "base/files/confine.h"
#include "base/files/files.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"

namespace throng::world {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// How many steps of a pointer lead to something.
std::size_t depth_in(const json& document, const std::string& pointer) {
  json::json_pointer place(pointer);
  std::size_t missing = 0;
  for (; !place.empty() && !document.contains(place); place.pop_back()) ++missing;
  std::size_t depth = 0;
  for (; !place.empty(); place.pop_back()) ++depth;
  return depth;
}

/// The file that a document extends. Throws InputError.
fs::path base_document(const json& document, const fs::path& file, const std::string& source) {
  constexpr const char* kExpected = "the name of a file in the same folder";
  const json& extends = document["extends"];
  if (!extends.is_string()) {
    throw InputError({source, "/extends", describe(extends), "text"});
  }
  const auto& name = extends.get_ref<const std::string&>();
  const fs::path base = fs::absolute(file).parent_path() / fs::path(name).filename();
  if (name.empty() || fs::path(name).filename() != name || !Confinement::allows(base)) {
    throw InputError({source, "/extends", describe(extends), kExpected});
  }
  if (!fs::is_regular_file(base)) {
    throw InputError({source, "/extends",
                      fmt::format("\"{}\", which does not exist beside this file", name),
                      kExpected});
  }
  return base;
}

}  // namespace

std::vector<Problem> ExtendedDocument::in_their_files(std::vector<Problem> problems) const {
  if (base.is_null()) return problems;
  for (Problem& problem : problems) {
    const bool is_place = problem.where.empty() || problem.where.starts_with('/');
    if (problem.source != file || !is_place) continue;
    if (depth_in(own, problem.where) < depth_in(base, problem.where)) problem.source = base_file;
  }
  return problems;
}

ExtendedDocument read_extended(const fs::path& file, const std::string& source) {
  ExtendedDocument read;
  read.file = source;
  read.own = parse_json(read_file(file), source);
  read.whole = read.own;
  if (!read.own.is_object() || !read.own.contains("extends")) return read;
  const fs::path base_file = base_document(read.own, file, source);
  read.base_file = (fs::path(source).parent_path() / base_file.filename()).string();
  read.base = parse_json(read_file(base_file), read.base_file);
  if (read.base.is_object() && read.base.contains("extends")) {
    throw InputError(
        {source, "/extends",
         fmt::format("\"{}\", which extends another file itself", base_file.filename().string()),
         "a file that stands for itself"});
  }
  json changes = read.own;
  changes.erase("extends");
  read.whole = read.base;
  read.whole.merge_patch(changes);
  return read;
}

}  // namespace throng::world
