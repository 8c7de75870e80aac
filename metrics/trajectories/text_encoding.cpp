#include "metrics/trajectories/text_encoding.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "base/text/utf8.h"

namespace throng::metrics {

namespace {

constexpr std::string_view kLittleEndianMark = "\xFF\xFE";
constexpr std::string_view kBigEndianMark = "\xFE\xFF";
constexpr std::size_t kLooked = 4096;

/// Share of zeros among the bytes at even or odd positions of the beginning.
double share_of_zeros(std::string_view bytes, std::size_t from) {
  const std::string_view looked = bytes.substr(0, kLooked);
  std::size_t zeros = 0;
  std::size_t all = 0;
  for (std::size_t i = from; i < looked.size(); i += 2, ++all) zeros += looked[i] == '\0' ? 1 : 0;
  return all == 0 ? 0 : static_cast<double>(zeros) / static_cast<double>(all);
}

bool is_big_endian(std::string_view bytes) {
  if (bytes.starts_with(kBigEndianMark)) return true;
  if (bytes.starts_with(kLittleEndianMark)) return false;
  return share_of_zeros(bytes, 0) > share_of_zeros(bytes, 1);
}

void add_code_point(std::uint32_t code, std::string& text) {
  const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xC0U | (code >> 6U));
  } else {
    if (code < 0x10000) {
      byte(0xE0U | (code >> 12U));
    } else {
      byte(0xF0U | (code >> 18U));
      byte(0x80U | ((code >> 12U) & 0x3FU));
    }
    byte(0x80U | ((code >> 6U) & 0x3FU));
  }
  byte(0x80U | (code & 0x3FU));
}

std::string from_utf16(std::string_view bytes) {
  const bool big = is_big_endian(bytes);
  const auto unit_at = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    const auto second = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(big ? first << 8U | second : second << 8U | first);
  };
  constexpr std::uint32_t kMark = 0xFEFF;
  constexpr std::uint32_t kHigh = 0xD800;
  constexpr std::uint32_t kLow = 0xDC00;
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit_at(i);
    if (i == 0 && code == kMark) continue;
    if (code >= kHigh && code < kLow && i + 3 < bytes.size()) {
      i += 2;
      code = 0x10000 + ((code - kHigh) << 10U) + (unit_at(i) & 0x3FFU);
    }
    add_code_point(code, text);
  }
  return text;
}

/// The kind of a file that is no text, by its first bytes; empty for text.
std::string_view binary_kind(std::string_view bytes) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kKinds = {
      {{"PK\x03\x04", "a ZIP archive, such as an Excel or OpenDocument table"},
       {"\xD0\xCF\x11\xE0", "an old Excel table"},
       {"\x89HDF", "HDF5"},
       {"SQLite format 3", "an SQLite database"},
       {"PAR1", "a Parquet table"},
       {"%PDF", "a PDF document"}}};
  for (const auto& [start, kind] : kKinds) {
    if (bytes.starts_with(start)) return kind;
  }
  return bytes.substr(0, kLooked).find('\0') == std::string_view::npos ? "" : "binary data";
}

}  // namespace

bool is_utf16(std::string_view bytes) {
  constexpr double kMany = 0.8;
  constexpr double kFew = 0.2;
  if (bytes.starts_with(kLittleEndianMark) || bytes.starts_with(kBigEndianMark)) return true;
  const double even = share_of_zeros(bytes, 0);
  const double odd = share_of_zeros(bytes, 1);
  return (even > kMany && odd < kFew) || (odd > kMany && even < kFew);
}

std::string decode_text(std::string_view bytes, const std::string& name) {
  if (is_utf16(bytes)) return from_utf16(bytes);
  if (const std::string_view kind = binary_kind(bytes); !kind.empty()) {
    throw InputError({name, "", std::string(kind),
                      "text or a table of trajectories; save it as CSV, or name its format"});
  }
  return std::string(without_byte_order_mark(bytes));
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMaxShown = 100;
  std::string out;
  for (const char c : text.substr(0, kMaxShown)) {
    const bool is_control = (c >= 0 && c < ' ' && c != '\t') || c == '\x7F';
    out += is_control ? '?' : c;
  }
  return text.size() > kMaxShown ? out + "..." : out;
}

}  // namespace throng::metrics
