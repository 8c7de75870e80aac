// Credentials of object stores ($AWS_...) apart from /proc/PID/environ, which any process of root
// reads, also one that works on untrusted input.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng::jobs {

/// Name and value of environment variables.
using CredentialVariables = std::vector<std::pair<std::string, std::string>>;

/// Whether a variable is not handed on to child processes: AWS_... and names that tell of a secret,
/// for example GITHUB_TOKEN.
bool is_secret_variable(std::string_view name);

/// The variables $AWS_... of this process, for the child that publishes.
CredentialVariables credential_variables();

/// Moves the environment to memory of this process: /proc/PID/environ shows nothing any more, and
/// getenv() works as before. Call it while the process has one thread.
void hide_environment();

/// A descriptor from which a child reads credentials with take_credentials(). Throws
/// EnvironmentError.
int descriptor_of_credentials(const CredentialVariables& variables);

/// Sets the variables that standard input has from descriptor_of_credentials(), if it is one.
void take_credentials();

}  // namespace throng::jobs
