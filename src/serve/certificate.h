#pragma once

#include <memory>
#include <string>
#include <vector>

#include <openssl/evp.h>
#include <openssl/x509.h>

namespace mimicry::serve {

struct Certificate {
  std::unique_ptr<X509, decltype(&X509_free)> certificate{nullptr, X509_free};
  std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key{nullptr, EVP_PKEY_free};
};

/// The certificate and key of a PEM file's content. Throws Error naming the file.
Certificate read_certificate(const std::string& pem, const std::string& name);
std::string write_certificate(const Certificate& certificate);

/// Self-signed for localhost and these IP addresses (texts), elliptic key on P-256, valid for 397
/// days, the most that browsers accept.
Certificate make_certificate(const std::vector<std::string>& addresses);

/// Valid for another week, and for all these addresses.
bool serves(const Certificate& certificate, const std::vector<std::string>& addresses);

}  // namespace mimicry::serve
