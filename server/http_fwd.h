// What of cpp-httplib headers have to know.
#pragma once

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib
