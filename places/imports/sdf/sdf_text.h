// The text of a Gazebo world in a form in which the line of an error identifies an element.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace throng::imports {

/// libsdformat rejects a whole world for one invalid value and reports only its line. In this text
/// each element starts on its own line, comments and declarations are removed, and parts can be
/// removed without moving others.
class SdfText {
 public:
  /// Throws InputError (`name`, line) if `text` is not XML or its root is not <sdf>.
  SdfText(const std::string& name, const std::string& text);

  /// The remaining text, for libsdformat.
  const std::string& text() const { return text_; }
  /// The line of the file that corresponds to a line of text().
  int line_of(int line) const;

  /// Names the element on a line of text(), such as "model a/link b", and its text.
  std::string label_at(int line) const;
  std::string value_at(int line) const;

  /// Sets the attribute "name" of the element on a line of text(), or its child <name>. Lines stay.
  void set_name_attribute(int line, const std::string& name);
  void set_name_element(int line, const std::string& name);

  struct Part {
    std::string name;  ///< "model a/link b/visual c"
    int line = 0;      ///< line in the file
  };
  /// Removes the smallest optional part that contains the element on a line of text(): a visual, a
  /// link, a model and so on. Returns nothing if only the world itself contains it.
  std::optional<Part> take_out(int line);

 private:
  struct Element {
    std::string name;
    std::string label;  ///< name with the value of its attribute "name"
    std::size_t begin = 0;
    std::size_t end = 0;
    int line = 0;
    int parent = -1;
  };
  void add_tag(const std::string& tag, int line);
  void close();
  std::string path_of(int element) const;
  const Element* element_at(int line) const;
  void replace(std::size_t at, std::size_t count, const std::string& with);

  std::string text_;
  std::vector<Element> elements_;  ///< the element on line i of text_ has index i - 1
  int open_ = -1;
};

}  // namespace throng::imports
