// The text of a Gazebo world, so that libsdformat's complaints find the part that they are about.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace throng::imports {

/// libsdformat gives up a whole world for one value that it cannot read, and says the line only.
/// Here each element begins a line of its own, comments and declarations are gone, and parts can be
/// taken out without moving the others.
class SdfText {
 public:
  /// Throws InputError (`name`, line) for what is no XML, or where the root is not <sdf>.
  SdfText(const std::string& name, const std::string& text);

  /// The remaining text, for libsdformat.
  const std::string& text() const { return text_; }
  /// The line of the file that a line of text() comes from.
  int line_of(int line) const;

  struct Part {
    std::string name;  ///< "model a/link b/visual c"
    int line = 0;      ///< in the file
  };
  /// Takes out the smallest part that a world can do without and that holds the element on a line
  /// of text(): a visual, a link, a model and so on. Nothing where that would be the world itself.
  std::optional<Part> take_out(int line);

 private:
  struct Element {
    std::string name;
    std::string label;  ///< with its attribute "name"
    std::size_t begin = 0;
    std::size_t end = 0;
    int line = 0;
    int parent = -1;
  };
  void add_tag(const std::string& tag, int line);
  void close();
  std::string path_of(int element) const;

  std::string text_;
  std::vector<Element> elements_;  ///< that on line i of text_ is the one before the i-th
  int open_ = -1;
};

}  // namespace throng::imports
