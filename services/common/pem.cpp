// SPDX-License-Identifier: Apache-2.0
#include "services/common/pem.hpp"

#include <openssl/pem.h>
#include <openssl/pkcs7.h>

namespace foretrack {
namespace {

constexpr double kDay_s = 86400.0;

Bytes open_file(const std::filesystem::path& path) {
  return Bytes(BIO_new_file(path.c_str(), "r"));
}

}  // namespace

Certificate read_certificate(const std::filesystem::path& path) {
  const Bytes file = open_file(path);
  return Certificate(file ? PEM_read_bio_X509(file.get(), nullptr, nullptr, nullptr) : nullptr);
}

Key read_key(const std::filesystem::path& path) {
  const Bytes file = open_file(path);
  // Without a password: nobody is there to type it.
  char none[] = "";
  return Key(file ? PEM_read_bio_PrivateKey(file.get(), nullptr, nullptr, none) : nullptr);
}

RevocationList read_revocations(const std::filesystem::path& path) {
  const Bytes file = open_file(path);
  return RevocationList(file ? PEM_read_bio_X509_CRL(file.get(), nullptr, nullptr, nullptr)
                             : nullptr);
}

std::string text_in(BIO& memory) {
  char* text = nullptr;
  const long size = BIO_get_mem_data(&memory, &text);
  return {text, static_cast<std::size_t>(size)};
}

std::string signed_text(const std::filesystem::path& path, X509& authority) {
  const Bytes file = open_file(path);
  BIO* content = nullptr;
  const std::unique_ptr<PKCS7, FreeBy<PKCS7_free>> document(
      file ? SMIME_read_PKCS7(file.get(), &content) : nullptr);
  const Bytes detached(content), out(BIO_new(BIO_s_mem()));
  const std::unique_ptr<X509_STORE, FreeBy<X509_STORE_free>> store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), &authority);
  if (!document || PKCS7_verify(document.get(), nullptr, store.get(), detached.get(), out.get(),
                                PKCS7_TEXT) != 1)
    return "";
  return text_in(*out);
}

std::string subject_of(const X509& certificate) {
  const Bytes out(BIO_new(BIO_s_mem()));
  X509_NAME_print_ex(out.get(), X509_get_subject_name(&certificate), 0, XN_FLAG_RFC2253);
  return text_in(*out);
}

double days_left(const X509& certificate) {
  int days = 0, seconds = 0;
  ASN1_TIME_diff(&days, &seconds, nullptr, X509_get0_notAfter(&certificate));
  return days + seconds / kDay_s;
}

bool has_begun(const X509& certificate) {
  return X509_cmp_current_time(X509_get0_notBefore(&certificate)) < 0;
}

bool is_revoked(const RevocationList& list, X509& certificate) {
  X509_REVOKED* entry = nullptr;
  return list && X509_CRL_get0_by_cert(list.get(), &entry, &certificate) == 1;
}

}  // namespace foretrack
