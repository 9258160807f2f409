// SPDX-License-Identifier: Apache-2.0
#include "services/security/authority.hpp"

#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509v3.h>

#include <stdexcept>

namespace foretrack::security {
namespace {

constexpr int kSerialBits = 127;
constexpr long kVersion3 = 2, kListVersion2 = 1;

using Number = std::unique_ptr<BIGNUM, FreeBy<BN_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, FreeBy<X509_EXTENSION_free>>;
using Time = std::unique_ptr<ASN1_TIME, FreeBy<ASN1_TIME_free>>;

template <class Result>
Result checked(Result result, const char* what) {
  if (result) return result;
  char why[256] = "";
  ERR_error_string_n(ERR_get_error(), why, sizeof why);
  throw std::runtime_error(std::string("OpenSSL cannot ") + what + ": " + why);
}

void set_serial(X509& certificate) {
  const Number number(BN_new());
  checked(BN_rand(number.get(), kSerialBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY), "draw a number");
  checked(BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(&certificate)), "number it");
}

void set_name(X509& certificate, const std::string& name, const std::string& owner) {
  auto* subject = X509_get_subject_name(&certificate);
  const auto add = [&](const char* field, const std::string& text) {
    checked(
        X509_NAME_add_entry_by_txt(subject, field, MBSTRING_UTF8,
                                   reinterpret_cast<const unsigned char*>(text.c_str()), -1, -1, 0),
        "name a certificate");
  };
  if (!owner.empty()) add("O", owner);
  add("CN", name);
}

void add_extension(X509& certificate, X509& issuer, int id, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, id, value));
  checked(extension && X509_add_ext(&certificate, extension.get(), -1), "extend a certificate");
}

// All but the issuer, the extensions and the signature.
Certificate begin_certificate(const std::string& name, const std::string& owner, EVP_PKEY& key,
                              const Validity& validity) {
  Certificate certificate(X509_new());
  X509_set_version(certificate.get(), kVersion3);
  set_serial(*certificate);
  set_name(*certificate, name, owner);
  checked(ASN1_TIME_set(X509_getm_notBefore(certificate.get()), validity.from) &&
              ASN1_TIME_set(X509_getm_notAfter(certificate.get()), validity.until) &&
              X509_set_pubkey(certificate.get(), &key),
          "make a certificate");
  return certificate;
}

template <class Write>
std::string written(Write write) {
  const Bytes out(BIO_new(BIO_s_mem()));
  checked(write(out.get()), "write");
  return text_in(*out);
}

void add_revoked(X509_CRL& list, const X509& certificate, const ASN1_TIME& when) {
  std::unique_ptr<X509_REVOKED, FreeBy<X509_REVOKED_free>> entry(X509_REVOKED_new());
  X509_REVOKED_set_serialNumber(entry.get(),
                                const_cast<ASN1_INTEGER*>(X509_get0_serialNumber(&certificate)));
  X509_REVOKED_set_revocationDate(entry.get(), const_cast<ASN1_TIME*>(&when));
  checked(X509_CRL_add0_revoked(&list, entry.get()), "revoke a certificate");
  entry.release();  // the list's
}

void add_former(X509_CRL& list, const RevocationList& former) {
  if (!former) return;
  auto* entries = X509_CRL_get_REVOKED(former.get());
  for (int i = 0; i < sk_X509_REVOKED_num(entries); ++i) {
    auto* copy = X509_REVOKED_dup(sk_X509_REVOKED_value(entries, i));
    checked(X509_CRL_add0_revoked(&list, copy), "revoke a certificate");
  }
}

}  // namespace

Key new_key() {
  return Key(checked(EVP_EC_gen("P-256"), "make a key"));
}

Authority new_authority(const std::string& name, const std::string& owner,
                        const Validity& validity) {
  Authority result{new_key(), nullptr};
  result.certificate = begin_certificate(name, owner, *result.key, validity);
  X509& own = *result.certificate;
  X509_set_issuer_name(&own, X509_get_subject_name(&own));
  add_extension(own, own, NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  // It signs documents as well, which the specification wants to be said.
  add_extension(own, own, NID_key_usage, "critical,keyCertSign,cRLSign,digitalSignature");
  add_extension(own, own, NID_subject_key_identifier, "hash");
  checked(X509_sign(&own, result.key.get(), EVP_sha256()), "sign a certificate");
  return result;
}

Certificate new_certificate(const Authority& authority, const std::string& name, EVP_PKEY& key,
                            const Validity& validity) {
  Certificate result = begin_certificate(name, "", key, validity);
  X509_set_issuer_name(result.get(), X509_get_subject_name(authority.certificate.get()));
  add_extension(*result, *authority.certificate, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(*result, *authority.certificate, NID_key_usage, "critical,digitalSignature");
  add_extension(*result, *authority.certificate, NID_authority_key_identifier, "keyid:always");
  checked(X509_sign(result.get(), authority.key.get(), EVP_sha256()), "sign a certificate");
  return result;
}

std::string signed_document(const Authority& authority, const std::string& text) {
  const Bytes content(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  constexpr int kHow = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const std::unique_ptr<PKCS7, FreeBy<PKCS7_free>> document(checked(
      PKCS7_sign(authority.certificate.get(), authority.key.get(), nullptr, content.get(), kHow),
      "sign a document"));
  return written(
      [&](BIO* out) { return SMIME_write_PKCS7(out, document.get(), content.get(), kHow); });
}

RevocationList new_revocations(const Authority& authority, const RevocationList& former,
                               const std::vector<Certificate>& revoked) {
  RevocationList list(X509_CRL_new());
  const Time now(X509_gmtime_adj(nullptr, 0));
  X509_CRL_set_version(list.get(), kListVersion2);
  X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(authority.certificate.get()));
  // From the authority's beginning, as the clock of a vehicle may be behind ours.
  X509_CRL_set1_lastUpdate(list.get(), X509_get0_notBefore(authority.certificate.get()));
  X509_CRL_set1_nextUpdate(list.get(), X509_get0_notAfter(authority.certificate.get()));
  add_former(*list, former);
  for (const auto& certificate : revoked) add_revoked(*list, *certificate, *now);
  X509_CRL_sort(list.get());
  checked(X509_CRL_sign(list.get(), authority.key.get(), EVP_sha256()), "sign the revocations");
  return list;
}

std::string pem_of(const X509& certificate) {
  return written([&](BIO* out) { return PEM_write_bio_X509(out, &certificate); });
}

std::string pem_of(const EVP_PKEY& key) {
  return written([&](BIO* out) {
    return PEM_write_bio_PrivateKey(out, &key, nullptr, nullptr, 0, nullptr, nullptr);
  });
}

std::string pem_of(const X509_CRL& list) {
  return written([&](BIO* out) { return PEM_write_bio_X509_CRL(out, &list); });
}

}  // namespace foretrack::security
