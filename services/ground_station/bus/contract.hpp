// SPDX-License-Identifier: Apache-2.0
// What the contract says of topics: services/common/topics.hpp as a table.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "services/common/names.hpp"

namespace foretrack::station {

struct ContractTopic {
  std::string_view name;
  Scope scope;
  std::string_view type;  // on the wire
  std::string_view profile;
};

std::span<const ContractTopic> contract();

/// The vehicle whose topic of the contract this is (rt/<vehicle>/<name>); empty: of none.
std::string_view vehicle_of(std::string_view wire_topic);
/// What the contract has for a topic on the wire; null: it is none of ours.
const ContractTopic* contract_of(std::string_view wire_topic);

}  // namespace foretrack::station
