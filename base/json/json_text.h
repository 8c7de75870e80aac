// Parsing of all JSON texts: request bodies, files, messages of other processes, rows of the
// database. Limits are checked during parsing, before values are created: nlohmann's values are
// copied, merged and printed recursively, so deep nesting would overflow the stack.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace throng {

/// Limits of a document.
struct JsonLimits {
  std::size_t max_depth = 64;  ///< nesting of arrays and objects
  std::size_t max_bytes = 512 << 20;
  std::size_t max_values = 5'000'000;       ///< objects, arrays and their elements at all levels
  std::size_t max_object_keys = 1'000'000;  ///< of one object
  std::size_t max_key_bytes = 1'000;
  std::size_t max_number_chars = 100;  ///< for numbers that 64 bits cannot hold
};

/// Limits for requests: at most about 20 MB of memory for values, in addition to the text.
inline constexpr JsonLimits kRequestJsonLimits = {.max_values = 200'000, .max_object_keys = 10'000};
/// Limits for jobs of any source; they leave room for fields that are added before a job is stored.
inline constexpr JsonLimits kJobJsonLimits = {
    .max_bytes = 16 << 20, .max_values = 1'000'000, .max_object_keys = 10'000};
/// Limits for files written by this program, such as the manifest of a large dataset.
inline constexpr JsonLimits kOwnJsonLimits = {.max_bytes = std::size_t{16} << 30,
                                              .max_values = 1'000'000'000};

/// Parses a document. Throws InputError with line and column or JSON pointer for malformed JSON
/// (RFC 8259; also invalid UTF-8 and lone surrogates), duplicate keys, numbers beyond the range of
/// a double, and exceeded limits. `source` is the name of the file in messages.
nlohmann::json parse_json(std::string_view text, const std::string& source,
                          const JsonLimits& limits = {});

/// Parses text written by this program. Throws EnvironmentError("`what` is damaged: ...").
nlohmann::json parse_own_json(std::string_view text, const std::string& what);

/// Parses a document, or returns a discarded value (is_discarded()) if parse_json() would throw.
nlohmann::json parse_json_or_discard(std::string_view text, const JsonLimits& limits = {});

/// Parses text that this program wrote and keeps the order of keys. Throws nlohmann's exceptions,
/// also for more than 64 levels of nesting.
nlohmann::ordered_json parse_ordered_json(std::string_view text);

/// Whether text written by this program is valid JSON; creates no value.
bool is_own_json(std::string_view text);

/// Parses a document written by this program whose root has a long list under `list_key`: calls
/// `on_element` for each element and does not store it. Throws EnvironmentError like
/// parse_own_json().
nlohmann::json parse_own_json_list(std::string_view text, const std::string& what,
                                   const std::string& list_key,
                                   const std::function<void(const nlohmann::json&)>& on_element);

}  // namespace throng
