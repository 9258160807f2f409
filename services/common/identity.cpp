// SPDX-License-Identifier: Apache-2.0
#include "services/common/identity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/x509_vfy.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "services/common/pem.hpp"
#include "services/common/roles.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
using namespace identity_file;

constexpr const char* kFiles[] = {kAuthority,  kCertificate, kKey, kPermissionsAuthority,
                                  kGovernance, kPermissions};
constexpr double kSoon_days = 30.0;

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
  if (!has_begun(certificate))
    return fmt::format("{} is not valid yet: is the clock right?", path.string());
  if (days_left(certificate) < 0.0) return fmt::format("{} is no longer valid", path.string());
  return "";
}

// What systemd hands over may be read by its group, which is root.
std::string fault_of_key_file(const fs::path& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0 || (about.st_mode & S_IRWXO) == 0) return "";
  return fmt::format(
      "{} can be read by everybody: chmod 600 it, and if others had the chance, "
      "revoke it",
      path.string());
}

std::string fault_of_own(const fs::path& folder, X509& own, X509& authority) {
  const fs::path path = folder / kCertificate;
  if (auto dates = fault_of_dates(own, path); !dates.empty()) return dates;
  if (auto dates = fault_of_dates(authority, folder / kAuthority); !dates.empty()) return dates;
  if (X509_verify(&own, X509_get0_pubkey(&authority)) != 1)
    return fmt::format("{} was not issued by {}", path.string(), kAuthority);
  if (is_revoked(read_revocations(folder / kRevocations), own))
    return fmt::format("{} was revoked, says {}", path.string(), kRevocations);
  return "";
}

std::vector<std::string> identities_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none_there;
  for (const auto& entry : fs::directory_iterator(folder, none_there))
    if (fs::exists(entry.path() / kCertificate)) names.push_back(entry.path().filename());
  return names;
}

}  // namespace

std::string identity_folder(const std::string& folder_name, std::string_view service) {
  const fs::path folder = folder_name;
  if (fs::exists(folder / kCertificate)) return folder_name;
  const auto there = identities_in(folder);
  if (there.empty()) return folder_name;  // fault_of_identity() says what is missing
  std::vector<std::string> wanted;
  for (const Role role : roles_of_service(service)) {
    wanted.emplace_back(name_of(role));
    if (fs::exists(folder / wanted.back() / kCertificate)) return folder / wanted.back();
  }
  throw std::invalid_argument(fmt::format("--security: {} has no identity of {}, only {}",
                                          folder_name, fmt::join(wanted, " or "),
                                          fmt::join(there, ", ")));
}

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
  if (X509_check_private_key(own.get(), key.get()) != 1)
    return fmt::format("{} is not the key of {}", (folder / kKey).string(), kCertificate);
  if (auto open = fault_of_key_file(folder / kKey); !open.empty()) return open;
  return fault_of_own(folder, *own, *authority);
}

std::string soon_over(const std::string& folder) {
  if (folder.empty()) return "";
  const fs::path path = fs::path(folder) / kCertificate;
  const Certificate own = read_certificate(path);
  if (!own || days_left(*own) > kSoon_days) return "";
  return fmt::format("{} ends in {:.0f} days; what is started after that stays out of the bus",
                     path.string(), days_left(*own));
}

bool demands_identity(const std::string& folder_name) {
  const fs::path folder = folder_name;
  const Certificate authority = read_certificate(folder / kPermissionsAuthority);
  return authority &&
         signed_text(folder / kGovernance, *authority)
                 .find("<allow_unauthenticated_participants>false") != std::string::npos;
}

std::vector<std::pair<std::string, std::string>> identity_properties(const std::string& folder) {
  const auto file = [&](const char* name) {
    return "file://" + (fs::absolute(folder) / name).string();
  };
  const std::string identity = "dds.sec.auth.builtin.PKI-DH.";
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  std::vector<std::pair<std::string, std::string>> properties = {
      {"dds.sec.auth.plugin", "builtin.PKI-DH"},
      {identity + "identity_ca", file(kAuthority)},
      {identity + "identity_certificate", file(kCertificate)},
      {identity + "private_key", file(kKey)},
      {"dds.sec.access.plugin", "builtin.Access-Permissions"},
      {access + "permissions_ca", file(kPermissionsAuthority)},
      {access + "governance", file(kGovernance)},
      {access + "permissions", file(kPermissions)},
      {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"}};
  if (fs::exists(fs::path(folder) / kRevocations))
    properties.emplace_back(identity + "identity_crl", file(kRevocations));
  return properties;
}

}  // namespace foretrack
