// SPDX-License-Identifier: Apache-2.0
#include "services/security/keystore.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "services/common/identity.hpp"

namespace foretrack::security {
namespace {

namespace fs = std::filesystem;
using namespace identity_file;

constexpr char kIdentityKey[] = "private/identity_ca.key.pem";
constexpr char kPermissionsKey[] = "private/permissions_ca.key.pem";
constexpr char kPublicAuthority[] = "public/identity_ca.cert.pem";
constexpr char kPublicPermissionsAuthority[] = "public/permissions_ca.cert.pem";
constexpr char kPublicRevocations[] = "public/crl.pem";
constexpr char kSignedGovernance[] = "enclaves/governance.p7s";
constexpr char kIssued[] = "issued";  // every certificate that was, by its number
constexpr char kVehicles[] = "foretrack vehicles", kSimulations[] = "foretrack simulations";
constexpr char kFleet[] = "fleet";
constexpr mode_t kSecret = 0600, kPublic = 0644;

// Whole or not at all, and never readable by others in between.
void write_file(const fs::path& path, const std::string& text, mode_t mode) {
  const std::string fresh = path.string() + ".new";
  unlink(fresh.c_str());
  const int file = open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  const bool written = file >= 0 &&
                       write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       fsync(file) == 0;
  if (file >= 0) close(file);
  if (!written || rename(fresh.c_str(), path.c_str()) != 0)
    throw std::runtime_error(fmt::format("{} cannot be written", path.string()));
}

void make_secret_folder(const fs::path& path) {
  fs::create_directories(path);
  fs::permissions(path, fs::perms::owner_all);
}

Authority read_authority(const fs::path& key, const fs::path& certificate) {
  Authority result{read_key(key), read_certificate(certificate)};
  if (!result.key)
    throw std::invalid_argument(fmt::format(
        "{} is no private key that may be read; `foretrack security init` makes a keystore",
        key.string()));
  if (!result.certificate)
    throw std::invalid_argument(fmt::format("{} is no certificate", certificate.string()));
  return result;
}

bool is_word(const std::string& text) {
  return std::ranges::all_of(
      text, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

std::string serial_of(const X509& certificate) {
  const std::unique_ptr<BIGNUM, FreeBy<BN_free>> number(
      ASN1_INTEGER_to_BN(X509_get0_serialNumber(&certificate), nullptr));
  char* text = BN_bn2hex(number.get());
  const std::string result = text;
  OPENSSL_free(text);
  return result;
}

void require(const Identity& identity, bool of_simulation) {
  Names names = identity.names;
  if (names.vehicle == kAllVehicles) names.vehicle = kFleet;
  validate_or_throw(names);
  if (!is_word(identity.person))
    throw std::invalid_argument(
        fmt::format("name '{}': lower-case letters, digits and _ are expected", identity.person));
  if (identity.role == Role::kSimulator && !of_simulation)
    throw std::invalid_argument(
        "a simulator has no identity among real vehicles, which would take its odometry for true; "
        "`foretrack security init FOLDER --simulation` makes a keystore for simulations");
}

}  // namespace

std::string enclave_of(const Identity& identity) {
  const auto& vehicle = identity.names.vehicle;
  return fmt::format("{}/{}{}{}", vehicle == kAllVehicles ? kFleet : vehicle,
                     name_of(identity.role), identity.person.empty() ? "" : "-", identity.person);
}

bool is_keystore(const fs::path& folder) {
  return fs::exists(folder / kPublicAuthority);
}

Keystore Keystore::create(const fs::path& folder, bool of_simulation, const Validity& validity) {
  if (is_keystore(folder))
    throw std::invalid_argument(fmt::format("{} is a keystore already", folder.string()));
  const char* owner = of_simulation ? kSimulations : kVehicles;
  Keystore store(folder, new_authority("identity authority", owner, validity),
                 new_authority("permissions authority", owner, validity));
  make_secret_folder(folder);
  make_secret_folder(folder / "private");
  for (const char* name : {"public", "enclaves", kIssued}) fs::create_directories(folder / name);
  write_file(folder / kIdentityKey, pem_of(*store.identities_.key), kSecret);
  write_file(folder / kPermissionsKey, pem_of(*store.permissions_.key), kSecret);
  write_file(folder / kPublicPermissionsAuthority, pem_of(*store.permissions_.certificate),
             kPublic);
  write_file(folder / kSignedGovernance, signed_document(store.permissions_, governance_text()),
             kPublic);
  store.write_revocations(new_revocations(store.identities_, nullptr, {}));
  write_file(folder / kPublicAuthority, pem_of(*store.identities_.certificate), kPublic);
  return store;
}

Keystore::Keystore(const fs::path& folder)
    : Keystore(folder, read_authority(folder / kIdentityKey, folder / kPublicAuthority),
               read_authority(folder / kPermissionsKey, folder / kPublicPermissionsAuthority)) {}

Keystore::Keystore(const fs::path& folder, Authority identities, Authority permissions)
    : folder_(folder),
      of_simulation_(subject_of(*identities.certificate).find(kSimulations) != std::string::npos),
      identities_(std::move(identities)),
      permissions_(std::move(permissions)) {}

fs::path Keystore::issue(const Identity& identity, Validity validity) {
  require(identity, of_simulation_);
  const std::string enclave = enclave_of(identity);
  const fs::path to = folder_of(enclave);
  make_secret_folder(to);
  const Key key = new_key();
  const Certificate certificate = new_certificate(identities_, '/' + enclave, *key, validity);
  const Grant grant{subject_of(*certificate), identity.role, identity.names, validity,
                    identity.domain_id};
  write_file(folder_ / kIssued / (serial_of(*certificate) + ".pem"), pem_of(*certificate), kPublic);
  write_file(to / kKey, pem_of(*key), kSecret);
  write_file(to / kCertificate, pem_of(*certificate), kPublic);
  write_file(to / kPermissions, signed_document(permissions_, permissions_text(grant)), kPublic);
  for (const auto& [from, name] : {std::pair{kPublicAuthority, kAuthority},
                                   {kPublicPermissionsAuthority, kPermissionsAuthority},
                                   {kSignedGovernance, kGovernance},
                                   {kPublicRevocations, kRevocations}})
    fs::copy_file(folder_ / from, to / name, fs::copy_options::overwrite_existing);
  return to;
}

std::vector<Certificate> Keystore::issued_to(const std::string& enclave) const {
  std::vector<Certificate> result;
  for (const auto& entry : fs::directory_iterator(folder_ / kIssued))
    if (auto certificate = read_certificate(entry.path());
        certificate && subject_of(*certificate) == "CN=/" + enclave)
      result.push_back(std::move(certificate));
  return result;
}

int Keystore::revoke(const std::string& enclave, bool all_but_last) {
  auto issued = issued_to(enclave);
  if (issued.empty())
    throw std::invalid_argument(fmt::format("nothing was issued to {} in {}; there are {}", enclave,
                                            folder_.string(), fmt::join(enclaves(), ", ")));
  const Certificate last = read_certificate(folder_of(enclave) / kCertificate);
  const RevocationList former = read_revocations(folder_ / kPublicRevocations);
  std::erase_if(issued, [&](const Certificate& one) {
    return is_revoked(former, *one) || (all_but_last && last && X509_cmp(&*one, &*last) == 0);
  });
  write_revocations(new_revocations(identities_, former, issued));
  return static_cast<int>(issued.size());
}

void Keystore::write_revocations(const RevocationList& list) {
  write_file(folder_ / kPublicRevocations, pem_of(*list), kPublic);
  for (const auto& enclave : enclaves())
    write_file(folder_of(enclave) / kRevocations, pem_of(*list), kPublic);
}

fs::path Keystore::folder_of(const std::string& enclave) const {
  return folder_ / "enclaves" / enclave;
}

std::vector<std::string> Keystore::enclaves() const {
  std::vector<std::string> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "enclaves"))
    if (entry.path().filename() == kCertificate)
      result.push_back(fs::relative(entry.path().parent_path(), folder_ / "enclaves"));
  std::ranges::sort(result);
  return result;
}

}  // namespace foretrack::security
