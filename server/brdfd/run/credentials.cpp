// SPDX-License-Identifier: Apache-2.0
#include "run/credentials.h"

#include "base/file_descriptor.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace brdf::service {
namespace {

void require_readable(const std::string& file) {
  if (::access(file.c_str(), R_OK) != 0) throw base::io_error(file, "read", errno);
}

}  // namespace

std::shared_ptr<grpc::ServerCredentials> listener_credentials(const ListenAddress& address, const Settings& s) {
  if (address.is_unix() || s.tls_certificate.empty()) return grpc::InsecureServerCredentials();
  require_readable(s.tls_certificate);
  require_readable(s.tls_key);
  if (!s.tls_client_ca.empty()) require_readable(s.tls_client_ca);
  const auto seconds = static_cast<unsigned>(std::max(1.0, s.tls_reload_seconds));
  const auto provider = std::make_shared<grpc::experimental::FileWatcherCertificateProvider>(s.tls_key, s.tls_certificate, s.tls_client_ca, seconds);
  grpc::experimental::TlsServerCredentialsOptions options(provider);
  options.watch_identity_key_cert_pairs();
  if (!s.tls_client_ca.empty()) {
    options.watch_root_certs();
    options.set_cert_request_type(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  } else {
    options.set_cert_request_type(GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE);
  }
  return grpc::experimental::TlsServerCredentials(options);
}

}  // namespace brdf::service
