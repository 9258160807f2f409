// SPDX-License-Identifier: Apache-2.0
#include "services/common/identity.hpp"

#include <fmt/format.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509_vfy.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace foretrack {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAuthority = "identity_ca.cert.pem";
constexpr const char* kCertificate = "cert.pem";
constexpr const char* kKey = "key.pem";
constexpr const char* kPermissionsAuthority = "permissions_ca.cert.pem";
constexpr const char* kGovernance = "governance.p7s";
constexpr const char* kPermissions = "permissions.p7s";
constexpr const char* kFiles[] = {kAuthority,  kCertificate, kKey, kPermissionsAuthority,
                                  kGovernance, kPermissions};

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open_file(const fs::path& path) {
  return {std::fopen(path.c_str(), "r"), std::fclose};
}

Certificate read_certificate(const fs::path& path) {
  const File file = open_file(path);
  return {file ? PEM_read_X509(file.get(), nullptr, nullptr, nullptr) : nullptr, X509_free};
}

Key read_key(const fs::path& path) {
  const File file = open_file(path);
  return {file ? PEM_read_PrivateKey(file.get(), nullptr, nullptr, nullptr) : nullptr,
          EVP_PKEY_free};
}

std::string missing_file(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return fmt::format("there is no folder {}", folder.string());
  for (const char* name : kFiles) {
    const fs::path path = folder / name;
    if (!fs::exists(path, error)) return fmt::format("{} is missing", path.string());
    if (access(path.c_str(), R_OK) != 0) return fmt::format("{} may not be read", path.string());
  }
  return "";
}

std::string fault_of_dates(const X509& certificate, const fs::path& path) {
  if (X509_cmp_current_time(X509_get0_notBefore(&certificate)) > 0)
    return fmt::format("{} is not valid yet: is the clock right?", path.string());
  if (X509_cmp_current_time(X509_get0_notAfter(&certificate)) < 0)
    return fmt::format("{} is no longer valid", path.string());
  return "";
}

using Input = std::unique_ptr<BIO, decltype(&BIO_free)>;

std::string text_in(BIO& memory) {
  char* text = nullptr;
  const long size = BIO_get_mem_data(&memory, &text);
  return {text, static_cast<std::size_t>(size)};
}

// What the document says, if the authority signed it; else nothing.
std::string signed_text(const fs::path& path, X509& authority) {
  const Input file(BIO_new_file(path.c_str(), "r"), BIO_free);
  BIO* content = nullptr;
  const std::unique_ptr<PKCS7, decltype(&PKCS7_free)> document(
      file ? SMIME_read_PKCS7(file.get(), &content) : nullptr, PKCS7_free);
  const Input detached(content, BIO_free), out(BIO_new(BIO_s_mem()), BIO_free);
  const std::unique_ptr<X509_STORE, decltype(&X509_STORE_free)> store(X509_STORE_new(),
                                                                      X509_STORE_free);
  X509_STORE_add_cert(store.get(), &authority);
  if (!document || PKCS7_verify(document.get(), nullptr, store.get(), detached.get(), out.get(),
                                PKCS7_TEXT) != 1)
    return "";
  return text_in(*out);
}

// As permissions name it: CN=name,O=owner.
std::string subject_of(const X509& certificate) {
  const Input out(BIO_new(BIO_s_mem()), BIO_free);
  X509_NAME_print_ex(out.get(), X509_get_subject_name(&certificate), 0, XN_FLAG_RFC2253);
  return text_in(*out);
}

}  // namespace

std::string refusal_of_identity(const std::string& folder_name) {
  const fs::path folder = folder_name;
  const Certificate own = read_certificate(folder / kCertificate);
  const Certificate authority = read_certificate(folder / kPermissionsAuthority);
  if (!own || !authority) return "permissions_ca.cert.pem or cert.pem is no certificate";
  for (const char* name : {kGovernance, kPermissions})
    if (signed_text(folder / name, *authority).empty())
      return fmt::format("{} was not signed by permissions_ca.cert.pem", (folder / name).string());
  const std::string subject = subject_of(*own);
  if (signed_text(folder / kPermissions, *authority).find(subject) == std::string::npos)
    return fmt::format("{} has no grant for {}", (folder / kPermissions).string(), subject);
  return fmt::format("the permissions in {} are not for this domain, or not valid now",
                     folder_name);
}

std::string fault_of_identity(const std::string& folder_name) {
  const fs::path folder = folder_name;
  if (auto missing = missing_file(folder); !missing.empty()) return missing;
  const Certificate authority = read_certificate(folder / kAuthority);
  if (!authority) return fmt::format("{} is no certificate", (folder / kAuthority).string());
  const Certificate own = read_certificate(folder / kCertificate);
  if (!own) return fmt::format("{} is no certificate", (folder / kCertificate).string());
  const Key key = read_key(folder / kKey);
  if (!key) return fmt::format("{} is no private key without a password", (folder / kKey).string());
  if (auto dates = fault_of_dates(*own, folder / kCertificate); !dates.empty()) return dates;
  if (auto dates = fault_of_dates(*authority, folder / kAuthority); !dates.empty()) return dates;
  if (X509_check_private_key(own.get(), key.get()) != 1)
    return fmt::format("{} is not the key of {}", (folder / kKey).string(), kCertificate);
  if (X509_verify(own.get(), X509_get0_pubkey(authority.get())) != 1)
    return fmt::format("{} was not issued by {}", (folder / kCertificate).string(), kAuthority);
  return "";
}

std::vector<std::pair<std::string, std::string>> identity_properties(const std::string& folder) {
  const auto file = [&](const char* name) {
    return "file://" + (fs::absolute(folder) / name).string();
  };
  const std::string identity = "dds.sec.auth.builtin.PKI-DH.";
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  return {{"dds.sec.auth.plugin", "builtin.PKI-DH"},
          {identity + "identity_ca", file(kAuthority)},
          {identity + "identity_certificate", file(kCertificate)},
          {identity + "private_key", file(kKey)},
          {"dds.sec.access.plugin", "builtin.Access-Permissions"},
          {access + "permissions_ca", file(kPermissionsAuthority)},
          {access + "governance", file(kGovernance)},
          {access + "permissions", file(kPermissions)},
          {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"}};
}

}  // namespace foretrack
