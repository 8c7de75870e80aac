// Readers for tests of exports, and of the dataset's own COCO file to compare with.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/files/files.h"

namespace throng::formats {

inline std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

inline std::vector<double> parse_numbers(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream text(line);
  std::vector<double> numbers;
  for (double number = 0; text >> number;) numbers.push_back(number);
  return numbers;
}

inline std::map<std::int64_t, nlohmann::json> images_by_id(const nlohmann::json& coco) {
  std::map<std::int64_t, nlohmann::json> images;
  for (const nlohmann::json& image : coco.at("images")) images[image.at("id")] = image;
  return images;
}

inline std::string image_stem(const nlohmann::json& image) {
  std::string name = image.at("file_name");
  name = name.substr(name.find('/') + 1, name.size() - name.find('/') - 5);
  std::replace(name.begin(), name.end(), '/', '-');
  return name;
}

/// The COCO file's annotations, in order, by the stem of their image.
inline std::map<std::string, std::vector<nlohmann::json>> people_by_stem(
    const nlohmann::json& coco) {
  const auto images = images_by_id(coco);
  std::map<std::string, std::vector<nlohmann::json>> people;
  for (const auto& [id, image] : images) people[image_stem(image)];
  for (const nlohmann::json& person : coco.at("annotations")) {
    people[image_stem(images.at(person.at("image_id")))].push_back(person);
  }
  return people;
}

inline double number(const nlohmann::json& value) { return value.get<double>(); }

}  // namespace throng::formats
