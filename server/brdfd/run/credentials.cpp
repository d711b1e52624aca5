// SPDX-License-Identifier: Apache-2.0
#include "run/credentials.h"

#include "base/file_descriptor.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace brdf::service {
namespace {

void require_readable(const std::string& file) {
  if (::access(file.c_str(), R_OK) != 0) throw base::io_error(file, "read", errno);
}

void require(bool holds, const std::string& sentence) {
  if (holds) return;
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  throw Error(ErrorCode::malformed, sentence + (reason == nullptr ? "" : std::string(": ") + reason));
}

}  // namespace

void check_tls_files(const Settings& s) {
  if (s.tls_certificate.empty()) return;
  for (const std::string& file : {s.tls_certificate, s.tls_key}) require_readable(file);
  const std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  require(context != nullptr, "libssl cannot be used");
  SSL_CTX_set_default_passwd_cb(context.get(), [](char*, int, int, void*) { return 0; });  // nobody is there to be asked
  require(SSL_CTX_use_PrivateKey_file(context.get(), s.tls_key.c_str(), SSL_FILETYPE_PEM) == 1, s.tls_key + " holds no private key without a password");
  // A certificate of another key replaces the key, without an error.
  require(SSL_CTX_use_certificate_chain_file(context.get(), s.tls_certificate.c_str()) == 1, s.tls_certificate + " holds no certificate");
  require(SSL_CTX_check_private_key(context.get()) == 1, s.tls_key + " does not belong to " + s.tls_certificate);
  if (s.tls_client_ca.empty()) return;
  require_readable(s.tls_client_ca);
  require(SSL_CTX_load_verify_locations(context.get(), s.tls_client_ca.c_str(), nullptr) == 1, s.tls_client_ca + " holds no certificate");
}

std::shared_ptr<grpc::ServerCredentials> listener_credentials(const ListenAddress& address, const Settings& s) {
  if (address.is_unix() || s.tls_certificate.empty()) return grpc::InsecureServerCredentials();
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
