// Complaints of libsdformat in the words of messages for users.
#pragma once

#include <string>

namespace sdf {
inline namespace v12 {
class Error;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// A complaint and what would be right: "<size> is \"5 x 1\"" and "3 numbers".
struct Complaint {
  std::string found;
  std::string expected;
  std::string text() const { return found + "; expected " + expected; }
};

/// Puts an error into words. `value` is the text of the element that it is about; "": unknown.
Complaint plain_complaint(const sdf::Error& error, const std::string& value = "");

}  // namespace throng::imports
