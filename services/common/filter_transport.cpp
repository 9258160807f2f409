// SPDX-License-Identifier: Apache-2.0
#include "services/common/filter_transport.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TCPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/TCPv6TransportDescriptor.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/UDPv6TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <stdexcept>

#include "services/common/interfaces.hpp"
#include "services/common/time_now.hpp"
#include "services/common/wire/heartbeat_watch.hpp"

namespace foretrack {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

std::string name_of(const Locator_t& locator) {
  if (locator.kind == LOCATOR_KIND_SHM) return "shared memory";
  return IPLocator::ip_to_string(locator);
}

class FilterTransport : public rtps::ChainingTransport {
 public:
  FilterTransport(const rtps::ChainingTransportDescriptor& below, Entrance entrance)
      : ChainingTransport(below), entrance_(std::move(entrance)) {}

  rtps::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }
  // ChainingTransport forgets it.
  void shutdown() override { low_level_transport_->shutdown(); }

  bool send(eprosima::fastrtps::rtps::SenderResource* below, const std::uint8_t* bytes,
            std::uint32_t size, eprosima::fastrtps::rtps::LocatorsIterator* begin,
            eprosima::fastrtps::rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override {
    return below->send(bytes, size, begin, end, timeout);
  }

  // A peer on this machine may name other addresses of it alone, which the library would not use if
  // they are not among ours; over the loopback one it is there as well.
  bool transform_remote_locator(const Locator_t& remote, Locator_t& result) const override {
    if (remote.kind == LOCATOR_KIND_UDPv4 && kind() == LOCATOR_KIND_UDPv4 &&
        low_level_transport_->is_local_locator(remote)) {
      Locator_t loopback = remote;
      IPLocator::setIPv4(loopback, kLoopbackAddress);
      if (low_level_transport_->is_locator_allowed(loopback)) {
        result = loopback;
        return true;
      }
    }
    return low_level_transport_->transform_remote_locator(remote, result);
  }

  void receive(rtps::TransportReceiverInterface* above, const std::uint8_t* bytes,
               std::uint32_t size, const Locator_t& local, const Locator_t& remote) override {
    if (is_outsider(remote)) return entrance_.filter->refuse_outsider();
    const auto [fault, message] = entrance_.filter->judge({bytes, size});
    if (fault != wire::Fault::kNone) return entrance_.filter->refuse(fault, name_of(remote));
    if (!heartbeats_.accepts(message, steady_s()))
      return entrance_.filter->refuse(wire::Fault::kSequence, name_of(remote));
    above->OnDataReceived(message.data(), static_cast<std::uint32_t>(message.size()), local,
                          remote);
  }

 private:
  // A socket hears what is multicast to any interface that somebody else on this machine listens
  // on.
  bool is_outsider(const Locator_t& remote) const {
    return entrance_.this_machine_only && remote.kind != LOCATOR_KIND_SHM &&
           !low_level_transport_->is_local_locator(remote);
  }

  Entrance entrance_;
  wire::HeartbeatWatch heartbeats_;
};

/// Stays what it is, as the library looks for shared memory by its type; but what it makes is
/// filtered.
template <class Transport>
struct Filtered : Transport {
  Filtered(const Transport& transport, Entrance through)
      : Transport(transport), entrance(std::move(through)) {}

  rtps::TransportInterface* create_transport() const override {
    return new FilterTransport(Below(*this), entrance);
  }

  Entrance entrance;

 private:
  struct Below : rtps::ChainingTransportDescriptor {
    explicit Below(const Transport& transport)
        : ChainingTransportDescriptor(std::make_shared<Transport>(transport)) {}
    rtps::TransportInterface* create_transport() const override { return nullptr; }
  };
};

// So many participants of one machine are found where only its address is named; the library's own
// number is 4.
constexpr std::uint32_t kPeersOfAMachine = 32;

void use_interfaces(rtps::SocketTransportDescriptor& transport, const Entrance& entrance) {
  transport.maxInitialPeersRange = kPeersOfAMachine;
  if (!entrance.interfaces.empty()) transport.interfaceWhiteList = entrance.interfaces;
}
void use_interfaces(rtps::SharedMemTransportDescriptor&, const Entrance&) {}

template <class Transport>
std::shared_ptr<rtps::TransportDescriptorInterface> filtered_if(
    const rtps::TransportDescriptorInterface& transport, const Entrance& entrance) {
  const auto* known = dynamic_cast<const Transport*>(&transport);
  if (!known) return nullptr;
  auto result = std::make_shared<Filtered<Transport>>(*known, entrance);
  use_interfaces(*result, entrance);
  return result;
}

void only_ipv4(const rtps::TransportDescriptorInterface& transport) {
  if (dynamic_cast<const rtps::UDPv6TransportDescriptor*>(&transport) ||
      dynamic_cast<const rtps::TCPv6TransportDescriptor*>(&transport))
    throw std::runtime_error(
        "qos/profiles.xml has a transport of IPv6: name its interfaces there (interfaceWhiteList), "
        "or say --interface any");
}

std::shared_ptr<rtps::TransportDescriptorInterface> filtered(
    const rtps::TransportDescriptorInterface& transport, const Entrance& entrance) {
  if (!entrance.interfaces.empty()) only_ipv4(transport);
  if (auto udp = filtered_if<rtps::UDPv4TransportDescriptor>(transport, entrance)) return udp;
  if (auto udp = filtered_if<rtps::UDPv6TransportDescriptor>(transport, entrance)) return udp;
  if (auto tcp = filtered_if<rtps::TCPv4TransportDescriptor>(transport, entrance)) return tcp;
  if (auto tcp = filtered_if<rtps::TCPv6TransportDescriptor>(transport, entrance)) return tcp;
  if (auto shm = filtered_if<rtps::SharedMemTransportDescriptor>(transport, entrance)) return shm;
  throw std::runtime_error("a transport in qos/profiles.xml is of a kind that is not filtered");
}

}  // namespace

bool names_interfaces(const Transports& transports) {
  return std::any_of(transports.begin(), transports.end(), [](const auto& transport) {
    const auto* socket = dynamic_cast<const rtps::SocketTransportDescriptor*>(transport.get());
    return socket && !socket->interfaceWhiteList.empty();
  });
}

bool stay_on_this_machine(const Transports& transports) {
  return std::all_of(transports.begin(), transports.end(), [](const auto& transport) {
    const auto* socket = dynamic_cast<const rtps::SocketTransportDescriptor*>(transport.get());
    return !socket || Interfaces{socket->interfaceWhiteList}.this_machine_only();
  });
}

Transports filtered_transports(const eprosima::fastdds::dds::TransportConfigQos& transport,
                               const Entrance& entrance) {
  Transports result;
  if (transport.use_builtin_transports) {
    result.push_back(filtered(rtps::UDPv4TransportDescriptor(), entrance));
    result.push_back(filtered(rtps::SharedMemTransportDescriptor(), entrance));
  }
  for (const auto& user : transport.user_transports) result.push_back(filtered(*user, entrance));
  return result;
}

}  // namespace foretrack
