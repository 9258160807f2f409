// SPDX-License-Identifier: Apache-2.0
#include "services/common/ros_graph.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo24.h"
#include "services/common/dds_impl.hpp"
#include "services/common/type_hash.hpp"

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

bool has_long_ids(const Node& node) {
  constexpr std::array<std::string_view, 3> kDistributions = {"foxy", "galactic", "humble"};
  return std::ranges::find(kDistributions, node.options().ros_distro) != kDistributions.end();
}

// 12 bytes of prefix, 4 of entity id, zeros to the end.
template <class Gid>
Gid gid_of(const GUID_t& guid) {
  Gid gid;
  gid.data().fill(0);
  std::memcpy(gid.data().data(), guid.guidPrefix.value, 12);
  std::memcpy(gid.data().data() + 12, guid.entityId.value, 4);
  return gid;
}

// Info as the distribution of ROS 2 has it.
template <class Info>
void write_info(Node& node) {
  using NodeInfo = typename std::decay_t<decltype(Info().node_entities_info_seq())>::value_type;
  using Gid = std::decay_t<decltype(Info().gid())>;
  auto& of_node = node.dds();
  if (!of_node.ros_discovery) {
    auto ops = type_ops<Info>();
    ops.name = TypeName<rmw_dds_common::msg::ParticipantEntitiesInfo>::value;
    dds::DataWriterQos qos;
    of_node.publisher->get_datawriter_qos_from_profile("latched", qos);
    if (!has_long_ids(node)) {  // Humble tells no hashes
      const auto told = told_of_type(ops.name);
      qos.user_data().data_vec(told);
    }
    of_node.ros_discovery =
        of_node.publisher->create_datawriter(of_node.topic(kRosGraphTopic, ops), qos);
  }
  Info info;
  info.gid(gid_of<Gid>(of_node.participant->guid()));
  NodeInfo entities;
  entities.node_namespace("/" + node.options().names.vehicle);
  entities.node_name(node.options().service);
  for (const auto& w : node.writers())
    entities.writer_gid_seq().push_back(gid_of<Gid>(w->dds->writer->guid()));
  for (const auto& r : node.readers())
    entities.reader_gid_seq().push_back(gid_of<Gid>(r->dds->reader->guid()));
  for (const auto& guid : of_node.shown_writers)
    entities.writer_gid_seq().push_back(gid_of<Gid>(guid));
  for (const auto& guid : of_node.shown_readers)
    entities.reader_gid_seq().push_back(gid_of<Gid>(guid));
  info.node_entities_info_seq().push_back(entities);
  if (of_node.ros_discovery) of_node.ros_discovery->write(&info);
}

}  // namespace

void announce_to_ros(Node& node) {
  if (has_long_ids(node))
    write_info<rmw_dds_common::msg::ParticipantEntitiesInfo24>(node);
  else
    write_info<rmw_dds_common::msg::ParticipantEntitiesInfo>(node);
}

}  // namespace foretrack
