// What of cpp-httplib headers have to know.
#pragma once

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib
