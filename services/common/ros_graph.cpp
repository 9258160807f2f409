// SPDX-License-Identifier: Apache-2.0
#include "services/common/ros_graph.hpp"

#include <cstring>
#include <type_traits>

#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo16.h"
#include "services/common/dds_impl.hpp"

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

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
  info.node_entities_info_seq().push_back(entities);
  if (of_node.ros_discovery) of_node.ros_discovery->write(&info);
}

}  // namespace

void announce_to_ros(Node& node) {
  if (node.options().ros == RosDistribution::kHumble)
    write_info<rmw_dds_common::msg::ParticipantEntitiesInfo>(node);
  else
    write_info<rmw_dds_common::msg::ParticipantEntitiesInfo16>(node);
}

}  // namespace foretrack
