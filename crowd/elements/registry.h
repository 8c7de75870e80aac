// Tables of the types of an element: the type's name, its attributes, and the function that creates
// it. A new type needs one row of such a table.
#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "crowd/elements/attributes.h"
#include "crowd/elements/suggest.h"

namespace throng::crowd {

/// A type of a Product. `make` gets the element, its checked attributes and the context.
template <typename Product, typename Context>
struct Plugin {
  using Make = std::unique_ptr<Product> (*)(const Element&, const Attributes&, Context&);

  std::string_view type;  ///< value of the element's attribute `type`
  std::string_view help;
  AttributeTable attributes;
  Make make;
};

/// All types of a Product in the order of the documentation.
template <typename Product, typename Context>
class Registry {
 public:
  using Entry = Plugin<Product, Context>;

  /// `common` are attributes of all types.
  explicit Registry(std::vector<std::vector<Entry>> groups, const AttributeTable& common = {}) {
    for (std::vector<Entry>& group : groups) {
      for (Entry& entry : group) {
        entry.attributes.insert(entry.attributes.begin(), common.begin(), common.end());
        entry.attributes.insert(entry.attributes.begin(), text("type", "the type"));
        entries_.push_back(std::move(entry));
      }
    }
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// Creates the Product of an element. Throws InputError for unknown types and invalid attributes.
  std::unique_ptr<Product> make(const Element& element, Context& context) const {
    const Entry& entry = find(element);
    return entry.make(element, Attributes(element, entry.attributes), context);
  }

  /// Returns the type of an element. Throws InputError if it is unknown.
  const Entry& find(const Element& element) const {
    const auto type = element.attribute("type");
    for (const Entry& entry : entries_) {
      if (type && entry.type == *type) return entry;
    }
    std::vector<std::string_view> known;
    for (const Entry& entry : entries_) known.push_back(entry.type);
    element.fail_attribute("type", type ? in_quotes(*type) + did_you_mean(*type, known) : "nothing",
                           known.empty() ? "nothing of the kind: there are no types"
                                         : fmt::format("one of {}", fmt::join(known, ", ")));
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace throng::crowd
