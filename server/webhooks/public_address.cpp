#include "server/webhooks/public_address.h"

#include <ifaddrs.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>

namespace throng::server {

namespace {

struct Block4 {
  std::uint32_t network;
  int bits;
};

constexpr std::uint32_t four(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return a << 24U | b << 16U | c << 8U | d;
}

constexpr std::array kSpecial4 = {
    Block4{four(0, 0, 0, 0), 8},        // this network
    Block4{four(10, 0, 0, 0), 8},       // private
    Block4{four(100, 64, 0, 0), 10},    // shared by customers of a provider
    Block4{four(127, 0, 0, 0), 8},      // loopback
    Block4{four(169, 254, 0, 0), 16},   // link-local, metadata of clouds
    Block4{four(172, 16, 0, 0), 12},    // private
    Block4{four(192, 0, 0, 0), 24},     // protocol assignments
    Block4{four(192, 0, 2, 0), 24},     // documentation
    Block4{four(192, 88, 99, 0), 24},   // 6to4 relays
    Block4{four(192, 168, 0, 0), 16},   // private
    Block4{four(198, 18, 0, 0), 15},    // benchmarks
    Block4{four(198, 51, 100, 0), 24},  // documentation
    Block4{four(203, 0, 113, 0), 24},   // documentation
    Block4{four(224, 0, 0, 0), 4},      // multicast
    Block4{four(240, 0, 0, 0), 4},      // reserved, broadcast
};

using Bytes6 = std::array<std::uint8_t, 16>;

struct Block6 {
  Bytes6 network;
  int bits;
};

constexpr Block6 kGlobalUnicast{{0x20}, 3};
constexpr std::array kSpecial6 = {
    Block6{{0x20, 0x01, 0x00, 0x00}, 23},  // protocol assignments, Teredo
    Block6{{0x20, 0x01, 0x0d, 0xb8}, 32},  // documentation
    Block6{{0x3f, 0xff, 0x00}, 20},        // documentation
};
constexpr Block6 k6to4{{0x20, 0x02}, 16};
constexpr Block6 kNat64{{0x00, 0x64, 0xff, 0x9b}, 96};
constexpr Block6 kMapped4{{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff}, 96};

bool is_in(const Bytes6& address, const Block6& block) {
  for (int bit = 0; bit < block.bits; ++bit) {
    const auto byte = static_cast<std::size_t>(bit / 8);
    const unsigned int mask = 0x80U >> static_cast<unsigned int>(bit % 8);
    if (((address[byte] ^ block.network[byte]) & mask) != 0) return false;
  }
  return true;
}

bool is_public_4(std::uint32_t address) {
  return std::none_of(kSpecial4.begin(), kSpecial4.end(), [&](const Block4& block) {
    return ((address ^ block.network) >> static_cast<unsigned int>(32 - block.bits)) == 0;
  });
}

/// The IPv4 address in four of the bytes.
std::uint32_t embedded(const Bytes6& address, std::size_t first) {
  return four(address[first], address[first + 1], address[first + 2], address[first + 3]);
}

bool is_public_6(const Bytes6& address) {
  constexpr std::size_t kLastFour = 12;
  if (is_in(address, kMapped4) || is_in(address, kNat64)) {
    return is_public_4(embedded(address, kLastFour));
  }
  if (is_in(address, k6to4)) return is_public_4(embedded(address, 2));
  return is_in(address, kGlobalUnicast) &&
         std::none_of(kSpecial6.begin(), kSpecial6.end(),
                      [&](const Block6& block) { return is_in(address, block); });
}

Bytes6 ipv6_bytes(const sockaddr& address) {
  sockaddr_in6 value{};
  std::memcpy(&value, &address, sizeof(value));
  Bytes6 bytes{};
  std::memcpy(bytes.data(), &value.sin6_addr, bytes.size());
  return bytes;
}

std::uint32_t ipv4_address(const sockaddr& address) {
  sockaddr_in value{};
  std::memcpy(&value, &address, sizeof(value));
  return ntohl(value.sin_addr.s_addr);
}

bool is_equal(const sockaddr& a, const sockaddr& b) {
  if (a.sa_family != b.sa_family) return false;
  return a.sa_family == AF_INET ? ipv4_address(a) == ipv4_address(b)
                                : ipv6_bytes(a) == ipv6_bytes(b);
}

bool is_of_this_machine(const sockaddr& address) {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return false;
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> all(first, &::freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr) continue;
    const auto family = entry->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) continue;
    if (is_equal(*entry->ifa_addr, address)) return true;
  }
  return false;
}

}  // namespace

bool is_public(const sockaddr& address) {
  if (address.sa_family == AF_INET) {
    return is_public_4(ipv4_address(address)) && !is_of_this_machine(address);
  }
  if (address.sa_family == AF_INET6) {
    return is_public_6(ipv6_bytes(address)) && !is_of_this_machine(address);
  }
  return false;
}

}  // namespace throng::server
