#include "jobs/bucket/digests.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/files/untrusted_folders.h"

namespace throng::bucket {

namespace {

class Hash {
 public:
  explicit Hash(const EVP_MD* kind) : kind_(kind), context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), kind_, nullptr);
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  /// The digest; the next bytes begin another.
  std::string take() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    EVP_DigestInit_ex(context_.get(), kind_, nullptr);
    return {digest.begin(), digest.begin() + size};
  }

 private:
  const EVP_MD* kind_;
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

class Digester {
 public:
  void add(std::string_view bytes) {
    sha256_.add(bytes);
    md5_.add(bytes);
  }
  Digest take() { return {encode_hex(sha256_.take()), md5_.take()}; }

 private:
  Hash sha256_{EVP_sha256()};
  Hash md5_{EVP_md5()};
};

}  // namespace

FileDigest digest_of_file(const std::filesystem::path& path, std::int64_t part_size_bytes) {
  constexpr std::int64_t kBlockBytes = 1 << 20;
  std::ifstream file = open_stream(path);
  if (!file) throw EnvironmentError(fmt::format("cannot read {}", path.string()));
  const bool has_parts =
      std::filesystem::file_size(path) > static_cast<std::uintmax_t>(part_size_bytes);
  std::vector<char> block(static_cast<std::size_t>(std::min(kBlockBytes, part_size_bytes)));
  FileDigest digest;
  Digester whole;
  Digester part;
  std::int64_t in_part = 0;
  while (file) {
    const std::int64_t left = has_parts ? part_size_bytes - in_part : kBlockBytes;
    file.read(block.data(), std::min(static_cast<std::int64_t>(block.size()), left));
    const std::string_view bytes(block.data(), static_cast<std::size_t>(file.gcount()));
    whole.add(bytes);
    if (has_parts) part.add(bytes);
    in_part += file.gcount();
    if (!has_parts || in_part < part_size_bytes) continue;
    digest.parts.push_back(part.take());
    in_part = 0;
  }
  if (file.bad()) throw EnvironmentError(fmt::format("cannot read {}", path.string()));
  if (has_parts && in_part > 0) digest.parts.push_back(part.take());
  digest.whole = whole.take();
  if (digest.parts.empty()) digest.parts.push_back(digest.whole);
  return digest;
}

Digest compute_digest(std::string_view bytes) {
  Digester digester;
  digester.add(bytes);
  return digester.take();
}

std::string tag_of_parts(const std::vector<Digest>& parts) {
  std::string md5s;
  for (const Digest& part : parts) md5s += part.md5;
  return fmt::format("{}-{}", encode_hex(compute_digest(md5s).md5), parts.size());
}

}  // namespace throng::bucket
