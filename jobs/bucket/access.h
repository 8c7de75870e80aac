// How an object store is reached: its endpoint, and the credentials, which come from the
// environment or from files and from nowhere else.
#pragma once

#include <string>

#include "spec/bucket/address.h"

namespace throng::bucket {

/// By the names and files of the AWS command line. Never printed or stored.
struct Access {
  std::string key_id = {};    ///< $AWS_ACCESS_KEY_ID, or aws_access_key_id of the profile
  std::string secret = {};    ///< $AWS_SECRET_ACCESS_KEY, or aws_secret_access_key
  std::string token = {};     ///< $AWS_SESSION_TOKEN, or aws_session_token; "": none
  std::string region = {};    ///< $AWS_REGION, $AWS_DEFAULT_REGION, or region
  std::string endpoint = {};  ///< $AWS_ENDPOINT_URL_S3, $AWS_ENDPOINT_URL, or endpoint_url; "": AWS
};

/// Reads the environment; what it lacks, from $AWS_SHARED_CREDENTIALS_FILE (default
/// ~/.aws/credentials) and $AWS_CONFIG_FILE (default ~/.aws/config), in the profile $AWS_PROFILE
/// (default "default"). Throws EnvironmentError that names what is missing, and InputError for an
/// endpoint that is no http or https URL, or has a user or password in it.
Access read_access();

/// URL of the bucket, to which "/" and a key are appended: by path at an endpoint of one's own and
/// for names with dots, which certificates do not cover, else by the bucket's own host.
std::string url_of_bucket(const Access& access, const Address& address);

}  // namespace throng::bucket
