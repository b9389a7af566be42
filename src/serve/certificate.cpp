#include "serve/certificate.h"

#include <algorithm>
#include <cstdint>
#include <ctime>

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <mimicry/base/error.h>

namespace mimicry::serve {
namespace {

constexpr long kDay_s = 24 * 60 * 60;
constexpr long kLifetime_days = 397;
constexpr long kLeastLeft_days = 7;

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;

void require(bool done) {
  if (done) return;
  char text[256] = "";
  ERR_error_string_n(ERR_get_error(), text, sizeof text);
  throw Error(ErrorKind::io, std::string("the certificate cannot be made: ") + text);
}

void add_extension(X509* certificate, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> extension(
      X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()), X509_EXTENSION_free);
  require(extension && X509_add_ext(certificate, extension.get(), -1) == 1);
}

}  // namespace

Certificate read_certificate(const std::string& pem, const std::string& name) {
  const auto open = [&] {
    return Bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), BIO_free);
  };
  Certificate made;
  made.certificate.reset(PEM_read_bio_X509(open().get(), nullptr, nullptr, nullptr));
  // An encrypted key's password is asked for by nobody.
  made.key.reset(PEM_read_bio_PrivateKey(
      open().get(), nullptr, [](char*, int, int, void*) { return 0; }, nullptr));
  if (!made.certificate || !made.key)
    throw Error(ErrorKind::invalid_input,
                name + ": no " + (made.certificate ? "key" : "certificate") +
                    " is in it; give a PEM file with both, the key not encrypted");
  if (X509_check_private_key(made.certificate.get(), made.key.get()) != 1)
    throw Error(
        ErrorKind::invalid_input,
        name + ": the key is not that of the certificate; give the two that belong together");
  return made;
}

std::string write_certificate(const Certificate& certificate) {
  const Bio out(BIO_new(BIO_s_mem()), BIO_free);
  require(out && PEM_write_bio_X509(out.get(), certificate.certificate.get()) == 1 &&
          PEM_write_bio_PrivateKey(out.get(), certificate.key.get(), nullptr, nullptr, 0, nullptr,
                                   nullptr) == 1);
  char* text = nullptr;
  const long size = BIO_get_mem_data(out.get(), &text);
  return {text, static_cast<std::size_t>(size)};
}

Certificate make_certificate(const std::vector<std::string>& addresses) {
  Certificate made;
  char curve[] = "P-256";
  made.key.reset(EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", curve));
  made.certificate.reset(X509_new());
  require(made.key && made.certificate);
  X509* c = made.certificate.get();
  std::uint64_t serial = 0;
  require(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1);
  require(X509_set_version(c, 2) == 1 &&
          ASN1_INTEGER_set_uint64(X509_get_serialNumber(c), serial >> 1) == 1);
  X509_gmtime_adj(X509_getm_notBefore(c), -kDay_s);
  X509_gmtime_adj(X509_getm_notAfter(c), (kLifetime_days - 1) * kDay_s);
  require(X509_set_pubkey(c, made.key.get()) == 1);
  X509_NAME* name = X509_get_subject_name(c);
  const auto* text = reinterpret_cast<const unsigned char*>("mimicry studio");
  require(X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, text, -1, -1, 0) == 1 &&
          X509_set_issuer_name(c, name) == 1);
  std::string names = "DNS:localhost";
  for (const std::string& address : addresses) names += ",IP:" + address;
  add_extension(c, NID_subject_alt_name, names);
  add_extension(c, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(c, NID_ext_key_usage, "serverAuth");
  require(X509_sign(c, made.key.get(), EVP_sha256()) > 0);
  return made;
}

bool serves(const Certificate& certificate, const std::vector<std::string>& addresses) {
  X509* c = certificate.certificate.get();
  std::time_t soon = std::time(nullptr) + kLeastLeft_days * kDay_s;
  return X509_cmp_time(X509_get0_notAfter(c), &soon) > 0 &&
         std::all_of(addresses.begin(), addresses.end(), [&](const std::string& address) {
           return X509_check_ip_asc(c, address.c_str(), 0) == 1;
         });
}

}  // namespace mimicry::serve
