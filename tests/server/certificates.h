// SPDX-License-Identifier: Apache-2.0
// Certificates of nobody, made for one test by libcrypto.
#pragma once

#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>

namespace brdf::test {

/// PEM texts.
struct Identity {
  std::string certificate, key;
};

/// When a certificate is valid, in seconds from now.
struct Validity {
  long from = -3600, until = 3600;
};
inline constexpr Validity expired{-7200, -3600};

class Authority {
 public:
  explicit Authority(const std::string& name) : key_(make_key()), certificate_(make(name, *key_, nullptr, {})) {}

  /// For clients and for servers on this machine.
  Identity issue(const std::string& name, const Validity& validity = {}) const {
    const Key key = make_key();
    const Certificate certificate = make(name, *key, this, validity);
    return {pem([&](BIO* to) { return PEM_write_bio_X509(to, certificate.get()); }),
            pem([&](BIO* to) { return PEM_write_bio_PrivateKey(to, key.get(), nullptr, nullptr, 0, nullptr, nullptr); })};
  }

  std::string certificate() const {
    return pem([this](BIO* to) { return PEM_write_bio_X509(to, certificate_.get()); });
  }

 private:
  template <auto free>
  struct Free {
    template <class T>
    void operator()(T* what) const {
      free(what);
    }
  };
  using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
  using Certificate = std::unique_ptr<X509, Free<X509_free>>;

  static void require(bool done) {
    if (!done) throw std::runtime_error("libcrypto makes no certificate");
  }

  static Key make_key() {
    Key key(EVP_EC_gen("P-256"));
    require(key != nullptr);
    return key;
  }

  template <class Write>
  static std::string pem(const Write& write) {
    const std::unique_ptr<BIO, Free<BIO_free_all>> to(BIO_new(BIO_s_mem()));
    require(to && write(to.get()) == 1);
    char* text = nullptr;
    const long size = BIO_get_mem_data(to.get(), &text);
    return {text, static_cast<std::size_t>(size)};
  }

  static void extend(X509& certificate, X509& issuer, int kind, const char* value) {
    X509V3_CTX context;
    X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
    const std::unique_ptr<X509_EXTENSION, Free<X509_EXTENSION_free>> extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
    require(extension && X509_add_ext(&certificate, extension.get(), -1) == 1);
  }

  /// Signed by itself where there is no issuer.
  static Certificate make(const std::string& name, EVP_PKEY& key, const Authority* issuer, const Validity& validity) {
    static std::atomic<long> serial{1};
    Certificate certificate(X509_new());
    require(certificate != nullptr);
    X509& c = *certificate;
    X509_set_version(&c, 2);
    ASN1_INTEGER_set(X509_get_serialNumber(&c), serial++);
    X509_gmtime_adj(X509_getm_notBefore(&c), validity.from);
    X509_gmtime_adj(X509_getm_notAfter(&c), validity.until);
    X509_NAME_add_entry_by_txt(X509_get_subject_name(&c), "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
    X509& signer = issuer != nullptr ? *issuer->certificate_ : c;
    X509_set_issuer_name(&c, X509_get_subject_name(&signer));
    X509_set_pubkey(&c, &key);
    if (issuer == nullptr) {
      extend(c, signer, NID_basic_constraints, "critical,CA:TRUE");
      extend(c, signer, NID_key_usage, "critical,keyCertSign,cRLSign");
    } else {
      extend(c, signer, NID_basic_constraints, "critical,CA:FALSE");
      extend(c, signer, NID_subject_alt_name, "DNS:localhost,IP:127.0.0.1");
    }
    require(X509_sign(&c, issuer != nullptr ? issuer->key_.get() : &key, EVP_sha256()) > 0);
    return certificate;
  }

  Key key_;
  Certificate certificate_;
};

}  // namespace brdf::test
