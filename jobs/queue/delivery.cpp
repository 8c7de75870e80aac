#include "jobs/queue/delivery.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "jobs/queue/dataset/publication.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

void write_delivery(const JobFolder& folder, const Delivery& delivery) {
  const json value = {
      {"address", delivery.address}, {"objects", delivery.objects}, {"bytes", delivery.bytes}};
  write_file_atomically(folder.output_of({Task::Kind::publish}), value.dump(kJsonIndent) + "\n");
}

std::optional<Delivery> read_delivery(const JobFolder& folder) {
  const fs::path file = folder.output_of({Task::Kind::publish});
  if (!fs::exists(file)) return std::nullopt;
  const json value = parse_own_json(read_file(file), file.string());
  try {
    return Delivery{value.at("address"), value.at("objects"), value.at("bytes")};
  } catch (const json::exception& error) {
    throw EnvironmentError(fmt::format("{} is damaged: {}", file.string(), error.what()));
  }
}

}  // namespace throng::jobs
