// SPDX-License-Identifier: Apache-2.0
// What identities are made of, read from PEM files by OpenSSL. Nothing of it knows DDS.
#pragma once

#include <openssl/evp.h>
#include <openssl/x509.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace foretrack {

template <auto kFree>
struct FreeBy {
  template <class T>
  void operator()(T* pointer) const {
    kFree(pointer);
  }
};
using Certificate = std::unique_ptr<X509, FreeBy<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, FreeBy<EVP_PKEY_free>>;
using RevocationList = std::unique_ptr<X509_CRL, FreeBy<X509_CRL_free>>;
using Bytes = std::unique_ptr<BIO, FreeBy<BIO_free>>;

/// Null: there is none in the file, or no such file.
Certificate read_certificate(const std::filesystem::path& file);
Key read_key(const std::filesystem::path& file);
RevocationList read_revocations(const std::filesystem::path& file);

/// What the document says, if the authority signed it; else nothing.
std::string signed_text(const std::filesystem::path& file, X509& authority);
/// As permissions name it: CN=name,O=owner.
std::string subject_of(const X509& certificate);
/// Until it ends; negative: it has.
double days_left(const X509& certificate);
bool has_begun(const X509& certificate);
bool is_revoked(const RevocationList& list, X509& certificate);
/// What was written into a memory of OpenSSL.
std::string text_in(BIO& memory);

}  // namespace foretrack
