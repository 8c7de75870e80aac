// Test for public network addresses: a webhook's URL comes from a user and must not make the
// service call itself, its neighbors or the metadata service of a cloud.
#pragma once

#include <netinet/in.h>

namespace throng::server {

/// Whether the address is globally reachable by IANA's registries of special-purpose addresses (RFC
/// 6890, 8190): not loopback, private, link-local, shared, multicast, reserved or for
/// documentation, no IPv6 address that embeds such an IPv4 address, and no address of this machine.
/// False for other address families.
bool is_public(const sockaddr& address);

}  // namespace throng::server
