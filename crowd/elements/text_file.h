// A file of text on disk or in memory.
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace throng::crowd {

struct TextFile {
  TextFile(std::filesystem::path file,
           const std::string* in_memory = nullptr)  // NOLINT(*-explicit-*)
      : path(std::move(file)), text(in_memory) {}

  /// The same for the same file, and for nothing else.
  std::string key() const {
    if (text == nullptr) return path.lexically_normal().string();
    return "in memory " + std::to_string(std::bit_cast<std::uintptr_t>(text));
  }

  std::filesystem::path path;  ///< where it is, or would be
  const std::string* text;     ///< what is in it; null: read it from disk
};

}  // namespace throng::crowd
