// Complaints of libsdformat in the words of messages for users.
#pragma once

#include <cstdint>
#include <string>

namespace sdf {
inline namespace v12 {
class Error;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// The way in which an error names its cause, the most telling one first.
enum class Cause : std::uint8_t {
  missing_file,  ///< a file that is not there, or cannot be read: others follow from it
  named,         ///< what is wrong
  consequence    ///< only that something is wrong
};

/// A complaint and what would be right: "<size> is \"5 x 1\"" and "3 numbers".
struct Complaint {
  std::string found;
  std::string expected;
  Cause cause = Cause::named;
  std::string text() const { return found + "; expected " + expected; }
};

/// Puts an error into words. `value` is the text of the element that it is about; "": unknown.
Complaint plain_complaint(const sdf::Error& error, const std::string& value = "");

}  // namespace throng::imports
