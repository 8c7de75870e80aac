// Which network addresses belong to the public internet: a webhook's URL comes from a user and must
// not make the service call itself, its neighbors or the metadata service of a cloud.
#pragma once

#include <netinet/in.h>

namespace throng::server {

/// Whether the address can be reached from anywhere, by the registries of IANA for special-purpose
/// addresses (RFC 6890, 8190): not loopback, private, link-local, shared, multicast, reserved, for
/// documentation; nor an IPv6 address that stands for such an IPv4 address; nor one of this
/// machine's own. False for other families.
bool is_public(const sockaddr& address);

}  // namespace throng::server
