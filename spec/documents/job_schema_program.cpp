// Writes what follows from tables in C++ and is read by other languages: spec/job/job.schema.json
// and python/throng/layouts.json. Usage: job_schema SOURCE_FOLDER
#include <cstdio>
#include <exception>
#include <filesystem>

#include "base/files/files.h"
#include "spec/documents/layouts.h"
#include "spec/job/spec.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: job_schema SOURCE_FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path source = argv[1];  // NOLINT(*-pointer-arithmetic)
    throng::write_file_atomically(source / "spec/job/job.schema.json",
                                  throng::jobs::job_schema_text());
    throng::write_file_atomically(source / "python/throng/layouts.json",
                                  throng::layouts::layouts_text());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "job_schema: %s\n", error.what());
    return 3;
  }
  return 0;
}
