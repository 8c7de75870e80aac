// A text file on disk or in memory.
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace throng::crowd {

/// A name with optional content; `text` must outlive the object.
struct TextFile {
  TextFile(std::filesystem::path file,
           const std::string* in_memory = nullptr)  // NOLINT(*-explicit-*)
      : path(std::move(file)), text(in_memory) {}

  /// Returns a key that is equal for equal files only.
  std::string key() const {
    if (text == nullptr) return path.lexically_normal().string();
    return "in memory " + std::to_string(std::bit_cast<std::uintptr_t>(text));
  }

  std::filesystem::path path;  ///< path; need not exist if the text is in memory
  const std::string* text;     ///< content; null: read from disk
};

}  // namespace throng::crowd
