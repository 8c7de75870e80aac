// The one place where JSON text becomes values: request bodies, files, messages of other processes
// and rows of the database. The limits are checked while the text is read, before anything is
// built: nlohmann's values copy, merge and print themselves by recursion, so that a deeply nested
// text would overflow the stack.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace throng {

struct JsonLimits {
  std::size_t max_depth = 64;  ///< arrays and objects within each other
  std::size_t max_bytes = 512 << 20;
  std::size_t max_values = 5'000'000;       ///< objects, arrays and what they hold, at all levels
  std::size_t max_object_keys = 1'000'000;  ///< of one object
  std::size_t max_key_bytes = 1'000;
  std::size_t max_number_chars = 100;  ///< of a number with more digits than 64 bits hold
};

/// Limits for input from the network: at most about 20 MB of memory for the values beside the text.
inline constexpr JsonLimits kRequestJsonLimits = {.max_values = 200'000, .max_object_keys = 10'000};
/// A job, wherever it comes from; with space for fields that are filled in before it is stored.
inline constexpr JsonLimits kJobJsonLimits = {
    .max_bytes = 16 << 20, .max_values = 1'000'000, .max_object_keys = 10'000};
/// Limits for files that this program has written itself, such as the manifest of a large dataset.
inline constexpr JsonLimits kOwnJsonLimits = {.max_bytes = std::size_t{16} << 30,
                                              .max_values = 1'000'000'000};

/// Parses a document. Throws InputError with the line and column, or the JSON pointer, for
/// malformed JSON (RFC 8259: also invalid UTF-8 and lone surrogates), for a key that an object
/// holds twice, for a number beyond the range of a double, and for whatever exceeds the limits.
/// `source` is the file's name for messages.
nlohmann::json parse_json(std::string_view text, const std::string& source,
                          const JsonLimits& limits = {});

/// Parses text that this program wrote. Throws EnvironmentError("`what` is damaged: ...").
nlohmann::json parse_own_json(std::string_view text, const std::string& what);

/// Parses a document, or returns a discarded value (is_discarded()) where parse_json() throws: for
/// callers with a message of their own.
nlohmann::json parse_json_or_discard(std::string_view text, const JsonLimits& limits = {});

/// Parses text that is part of this program, whose keys keep their order.
nlohmann::ordered_json parse_ordered_json(std::string_view text);

/// Whether text that this program wrote is valid JSON, without building the value.
bool is_own_json(std::string_view text);

/// Parses a document that this program wrote and whose root has a long list under `list_key`: its
/// elements are handed over one by one and not kept. Throws EnvironmentError as parse_own_json().
nlohmann::json parse_own_json_list(std::string_view text, const std::string& what,
                                   const std::string& list_key,
                                   const std::function<void(const nlohmann::json&)>& on_element);

}  // namespace throng
