// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/bus/contract.hpp"

#include <algorithm>
#include <array>

#include "services/common/topics.hpp"

namespace foretrack::station {
namespace {

constexpr std::string_view kRoot = "rt/";

template <class... Topic>
constexpr auto table_of(std::tuple<Topic...>*) {
  return std::array{ContractTopic{Topic::info.name, Topic::info.scope,
                                  TypeName<typename Topic::Type>::value, Topic::info.profile}...};
}

constexpr auto kTable = table_of(static_cast<topics::All*>(nullptr));

const ContractTopic* find(std::string_view name, bool of_vehicle) {
  const auto it = std::find_if(kTable.begin(), kTable.end(), [&](const ContractTopic& t) {
    return t.name == name && (t.scope == Scope::kVehicle) == of_vehicle;
  });
  return it == kTable.end() ? nullptr : it;
}

}  // namespace

std::span<const ContractTopic> contract() {
  return kTable;
}

std::string_view vehicle_of(std::string_view wire_topic) {
  if (!wire_topic.starts_with(kRoot)) return {};
  const auto rest = wire_topic.substr(kRoot.size());
  const auto slash = rest.find('/');
  if (slash == std::string_view::npos || !find(rest.substr(slash + 1), true)) return {};
  return rest.substr(0, slash);
}

const ContractTopic* contract_of(std::string_view wire_topic) {
  if (!wire_topic.starts_with(kRoot)) return nullptr;
  auto rest = wire_topic.substr(kRoot.size());
  if (const auto* shared = find(rest, false)) return shared;
  const auto slash = rest.find('/');
  return slash == std::string_view::npos ? nullptr : find(rest.substr(slash + 1), true);
}

}  // namespace foretrack::station
