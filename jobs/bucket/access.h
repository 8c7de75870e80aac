// Access to an object store: endpoint and credentials, which are read from the environment and from
// files only.
#pragma once

#include <string>

#include "spec/bucket/address.h"

namespace throng::bucket {

/// Endpoint and credentials, under the names of the AWS command line. Never printed or stored.
struct Access {
  std::string key_id = {};    ///< $AWS_ACCESS_KEY_ID, or aws_access_key_id of the profile
  std::string secret = {};    ///< $AWS_SECRET_ACCESS_KEY, or aws_secret_access_key
  std::string token = {};     ///< $AWS_SESSION_TOKEN, or aws_session_token; "": none
  std::string region = {};    ///< $AWS_REGION, $AWS_DEFAULT_REGION, or region
  std::string endpoint = {};  ///< $AWS_ENDPOINT_URL_S3, $AWS_ENDPOINT_URL, or endpoint_url; "": AWS
};

/// Reads the environment, and missing values from $AWS_SHARED_CREDENTIALS_FILE (default
/// ~/.aws/credentials) and $AWS_CONFIG_FILE (default ~/.aws/config), profile $AWS_PROFILE (default
/// "default"). Throws EnvironmentError that names the missing values, and InputError for an
/// endpoint that is no http or https URL or contains a user or password.
Access read_access();

/// URL of the bucket, to which "/" and a key can be appended. The bucket is part of the path for a
/// custom endpoint and for names with dots, which wildcard certificates do not cover; otherwise it
/// is part of the host name.
std::string url_of_bucket(const Access& access, const Address& address);

}  // namespace throng::bucket
