// Forward declarations of cpp-httplib.
#pragma once

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib
