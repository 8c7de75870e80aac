// Addresses in object stores to which jobs may publish their datasets. The operator chooses them,
// because the service's credentials are used.
#pragma once

#include <string>
#include <vector>

#include "spec/bucket/address.h"

namespace throng::server {

/// The permitted addresses.
class PublishTargets {
 public:
  /// Parses the addresses of `throng serve --publish-to`. Throws InputError.
  explicit PublishTargets(const std::vector<std::string>& allowed = {});

  bool are_there() const { return !allowed_.empty(); }
  /// Throws InputError unless a job's address is "", a permitted address or below one.
  void require(const std::string& address) const;

 private:
  std::vector<bucket::Address> allowed_;
};

}  // namespace throng::server
