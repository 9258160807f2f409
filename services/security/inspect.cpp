// SPDX-License-Identifier: Apache-2.0
#include "services/security/inspect.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "services/common/identity.hpp"
#include "services/common/pem.hpp"
#include "services/security/permissions.hpp"

namespace foretrack::security {
namespace {

namespace fs = std::filesystem;
using namespace identity_file;

// Its owner's alone.
std::string fault_of_secret(const fs::path& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0 || (about.st_mode & (S_IRWXG | S_IRWXO)) == 0) return "";
  return fmt::format("{} can be read by others: chmod 600 it", path.string());
}

std::string fault_of_documents(const fs::path& folder, const std::string& subject) {
  const Certificate authority = read_certificate(folder / kPermissionsAuthority);
  if (!authority) return fmt::format("{} is no certificate", kPermissionsAuthority);
  for (const char* name : {kGovernance, kPermissions})
    if (signed_text(folder / name, *authority).empty())
      return fmt::format("{} was not signed by {}", name, kPermissionsAuthority);
  if (signed_text(folder / kPermissions, *authority)
          .find("<subject_name>" + subject + "</subject_name>") == std::string::npos)
    return fmt::format("{} has no grant for {}", kPermissions, subject);
  return "";
}

// "CN=/uav1/operator-ada": vehicle uav1, role operator.
std::optional<Role> role_in(const std::string& subject, std::string& vehicle) {
  const auto begin = subject.find("CN=/");
  const auto slash = subject.find('/', begin + 4);
  if (begin == std::string::npos || slash == std::string::npos) return std::nullopt;
  vehicle = subject.substr(begin + 4, slash - begin - 4);
  return role_of(std::string_view(subject).substr(slash + 1, subject.find('-') - slash - 1));
}

// What the role may write by this version, and not by the document, which an older one made. Names
// of the flight controller and the clock are the user's own.
std::string missing_topic(const fs::path& folder, const std::string& subject) {
  Names names;
  const auto role = role_in(subject, names.vehicle);
  const Certificate authority = read_certificate(folder / kPermissionsAuthority);
  if (!role || !authority) return "";
  const auto document = signed_text(folder / kPermissions, *authority);
  for (const auto& topic : writable_topics(*role, names))
    if (topic.starts_with("rt/" + names.vehicle + '/') &&
        document.find("<topic>" + topic + "</topic>") == std::string::npos)
      return topic;
  return "";
}

Inspection inspect_one(const fs::path& folder) {
  Inspection result{.folder = folder};
  if (const Certificate own = read_certificate(folder / kCertificate)) {
    const std::string subject = subject_of(*own);
    result.name = subject.substr(subject.find('/') == std::string::npos ? 0 : subject.find('/'));
    result.days_left = days_left(*own);
    result.fault = fault_of_documents(folder, subject);
    if (const auto topic = missing_topic(folder, subject); !topic.empty())
      result.advice = fmt::format("may not write {}: issue it again", topic);
  }
  if (auto fault = fault_of_secret(folder / kKey); !fault.empty()) result.fault = fault;
  if (auto fault = fault_of_identity(folder); !fault.empty()) result.fault = fault;
  if (result.advice.empty()) result.advice = soon_over(folder);
  return result;
}

}  // namespace

std::vector<Inspection> inspect(const fs::path& folder) {
  std::vector<Inspection> result;
  std::error_code none_there;
  if (fs::exists(folder / kCertificate)) return {inspect_one(folder)};
  for (const auto& entry : fs::recursive_directory_iterator(folder, none_there))
    if (entry.path().filename() == kCertificate)
      result.push_back(inspect_one(entry.path().parent_path()));
  for (const auto& entry : fs::directory_iterator(folder / "private", none_there))
    if (auto fault = fault_of_secret(entry.path()); !fault.empty())
      result.push_back({.folder = folder / "private", .name = "authority", .fault = fault});
  std::ranges::sort(result, {}, &Inspection::name);
  return result;
}

}  // namespace foretrack::security
