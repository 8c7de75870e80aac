// Addresses in object stores that jobs may publish their datasets to: the operator's choice, since
// the service's credentials are used.
#pragma once

#include <string>
#include <vector>

#include "spec/bucket/address.h"

namespace throng::server {

class PublishTargets {
 public:
  /// `allowed` as `throng serve --publish-to` has them. Throws InputError.
  explicit PublishTargets(const std::vector<std::string>& allowed = {});

  bool are_there() const { return !allowed_.empty(); }
  /// Throws InputError unless a job's address is one of them or below it; nothing for "".
  void require(const std::string& address) const;

 private:
  std::vector<bucket::Address> allowed_;
};

}  // namespace throng::server
