#include "base/files/hash.h"

#include <fmt/format.h>
#include <isa-l/crc.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <vector>

#include "base/files/read_only_file.h"

namespace throng {

namespace {

class Sha256 {
 public:
  static constexpr std::size_t kBytes = 32;

  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }
  void add(const void* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }
  std::string hex() { return encode_hex(digest()); }
  std::string base64() { return encode_base64(digest()); }

 private:
  std::string digest() {
    std::array<unsigned char, kBytes> digest{};
    EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr);
    return {digest.begin(), digest.end()};
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string encode_hex(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

std::string encode_base64(std::string_view bytes) {
  std::vector<unsigned char> text(4 * ((bytes.size() + 2) / 3) + 1);
  const int length =
      EVP_EncodeBlock(text.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                      static_cast<int>(bytes.size()));
  return {text.begin(), text.begin() + length};
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hex();
}

std::string sha256_base64(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.base64();
}

std::uint32_t crc32(std::string_view bytes) {
  return crc32_gzip_refl(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

FileHashes hashes_of_file(const std::filesystem::path& path) {
  const ReadOnlyFile file(path);
  Sha256 hash;
  FileHashes hashes;
  std::vector<char> block(1 << 20);
  std::int64_t offset = 0;
  for (std::size_t count = 1; count > 0; offset += static_cast<std::int64_t>(count)) {
    count = file.read_at(offset, block);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(block.data());
    hash.add(bytes, count);
    hashes.crc32 = crc32_gzip_refl(hashes.crc32, bytes, count);
  }
  hashes.sha256_hex = hash.hex();
  return hashes;
}

std::string sha256_hex_of_file(const std::filesystem::path& path) {
  return hashes_of_file(path).sha256_hex;
}

}  // namespace throng
