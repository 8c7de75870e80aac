#include "jobs/bucket/listing.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.h"

namespace throng::bucket {

namespace {

using tinyxml2::XMLElement;

std::string text_in(const XMLElement& element, const char* name) {
  const XMLElement* child = element.FirstChildElement(name);
  const char* text = child == nullptr ? nullptr : child->GetText();
  return text == nullptr ? "" : text;
}

/// An answer whose root has this name.
class Answer {
 public:
  Answer(const std::string& xml, std::string_view root_name) {
    const bool is_xml = document_.Parse(xml.data(), xml.size()) == tinyxml2::XML_SUCCESS;
    root_ = is_xml ? document_.RootElement() : nullptr;
    if (root_ == nullptr || root_name != root_->Name()) {
      throw EnvironmentError(
          fmt::format("the object store's answer is no {}, but {} bytes of something else",
                      root_name, xml.size()));
    }
  }

  const XMLElement& root() const { return *root_; }

  template <typename Visit>
  void for_each(const char* name, Visit visit) const {
    for (const XMLElement* one = root_->FirstChildElement(name); one != nullptr;
         one = one->NextSiblingElement(name)) {
      visit(*one);
    }
  }

  /// Pairs of a query parameter and the element that holds its value for the next page.
  Pairs next(std::initializer_list<std::pair<const char*, const char*>> names) const {
    Pairs query;
    if (text_in(*root_, "IsTruncated") != "true") return query;
    for (const auto& [parameter, element] : names) {
      query.emplace_back(parameter, text_in(*root_, element));
    }
    if (query.front().second.empty()) {
      throw EnvironmentError("the object store's listing goes on, and does not say where");
    }
    return query;
  }

 private:
  tinyxml2::XMLDocument document_;
  const XMLElement* root_ = nullptr;
};

std::int64_t number_in(const XMLElement& element, const char* name) {
  return std::strtoll(text_in(element, name).c_str(), nullptr, 10);
}

}  // namespace

void ListingBound::add_page(const Pairs& next) {
  constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;
  constexpr int kMaxPages = 100'000;
  if (bytes_ > kMaxBytes || ++pages_ > kMaxPages) {
    throw EnvironmentError(
        fmt::format("the object store's listing does not end: {} pages with {} bytes until now, "
                    "expected at most {} pages and {} bytes",
                    pages_, bytes_, kMaxPages, kMaxBytes));
  }
  if (!next.empty() && next == next_) {
    throw EnvironmentError("the object store's listing goes on with the page that it just sent");
  }
  next_ = next;
}

Page<ListedObject> read_objects(const std::string& xml) {
  const Answer answer(xml, "ListBucketResult");
  Page<ListedObject> page;
  answer.for_each("Contents", [&](const XMLElement& one) {
    page.entries.push_back(
        {text_in(one, "Key"), number_in(one, "Size"), without_quotes(text_in(one, "ETag"))});
  });
  page.next = answer.next({{"continuation-token", "NextContinuationToken"}});
  return page;
}

Page<ListedUpload> read_uploads(const std::string& xml) {
  const Answer answer(xml, "ListMultipartUploadsResult");
  Page<ListedUpload> page;
  answer.for_each("Upload", [&](const XMLElement& one) {
    page.entries.push_back({text_in(one, "Key"), text_in(one, "UploadId")});
  });
  page.next =
      answer.next({{"key-marker", "NextKeyMarker"}, {"upload-id-marker", "NextUploadIdMarker"}});
  return page;
}

Page<ListedPart> read_parts(const std::string& xml) {
  const Answer answer(xml, "ListPartsResult");
  Page<ListedPart> page;
  answer.for_each("Part", [&](const XMLElement& one) {
    page.entries.push_back({static_cast<int>(number_in(one, "PartNumber")), number_in(one, "Size"),
                            without_quotes(text_in(one, "ETag"))});
  });
  page.next = answer.next({{"part-number-marker", "NextPartNumberMarker"}});
  return page;
}

std::string read_value(const std::string& xml, const char* name) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) return "";
  const XMLElement* root = document.RootElement();
  return root == nullptr ? "" : text_in(*root, name);
}

StoreError read_error(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (xml.find("<Error>") == std::string::npos ||
      document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    return {};
  }
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "Error") return {};
  return {first_line(text_in(*root, "Code")), first_line(text_in(*root, "Message"))};
}

std::string error_text(const StoreError& error, long status) {
  if (error.code.empty()) return fmt::format("the object store answered with status {}", status);
  if (error.message.empty()) return error.code;
  return fmt::format("{}: {}", error.code, error.message);
}

std::string first_line(std::string_view text) {
  constexpr std::size_t kMaxBytes = 300;
  const auto is_control = [](unsigned char c) { return c < ' ' || c >= 0x7F; };
  std::string line(text.substr(0, std::min(text.find('\n'), kMaxBytes)));
  std::replace_if(line.begin(), line.end(), is_control, '?');
  return line;
}

std::string without_quotes(std::string_view tag) {
  std::string text;
  std::copy_if(tag.begin(), tag.end(), std::back_inserter(text), [](char c) { return c != '"'; });
  return text;
}

}  // namespace throng::bucket
