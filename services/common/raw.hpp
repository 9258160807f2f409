// SPDX-License-Identifier: Apache-2.0
// Endpoints of any topic without its type: samples are CDR bytes, header included.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/common/peer.hpp"
#include "services/common/type_ops.hpp"

namespace eprosima::fastdds::dds {
class StatusCondition;
}

namespace foretrack {

class Node;

/// A sample as it is on the wire: 4 bytes of encapsulation, then XCDR1.
using CdrBytes = std::vector<std::uint8_t>;

struct RawTopic {
  std::string name;  // as on the wire: rt/uav1/odometry
  std::string type;  // nav_msgs::msg::dds_::Odometry_
  bool keyed = false;
};

/// Who asks a service, and which of its requests it is.
struct RequestId {
  std::array<std::uint8_t, 16> writer{};
  std::array<std::uint8_t, 16> reader{};  // where it hears replies; zeros: it does not say
  std::int64_t number = 0;
};

/// A node has at most one type for each topic and cannot have typed endpoints of it as well.
class RawReader {
 public:
  struct Dds;
  /// `profile` is of qos/profiles.xml. Throws std::runtime_error if DDS refuses.
  RawReader(Node& node, const RawTopic& topic, const char* profile);
  ~RawReader();
  /// False: nothing is left. `from`, if it is asked for: whose sample it is.
  bool take(CdrBytes& sample, PeerId* from = nullptr);
  /// The same, of a service's requests.
  bool take_request(CdrBytes& sample, RequestId& from);
  /// Among the endpoints that the node announces to ROS 2.
  void show_to_ros();
  /// Of samples that came.
  eprosima::fastdds::dds::StatusCondition& condition();
  Dds& dds() { return *dds_; }

 private:
  std::unique_ptr<Dds> dds_;
};

class RawWriter {
 public:
  struct Dds;
  /// Throws as RawReader.
  RawWriter(Node& node, const RawTopic& topic, const char* profile);
  ~RawWriter();
  bool write(const CdrBytes& sample);
  int readers() const;
  bool reply(const CdrBytes& sample, const RequestId& to);
  /// Whether the one who asked, or another reader of its participant, is matched, and has been for
  /// long enough to hear what is written now.
  bool reaches(const RequestId& asker) const;
  void show_to_ros();

 private:
  std::unique_ptr<Dds> dds_;
};

/// Waits for any of some readers. For one thread.
class RawWait {
 public:
  RawWait();
  ~RawWait();
  void add(RawReader& reader);
  void remove(RawReader& reader);
  /// Returns early when a sample came.
  void wait(double longest_s);

 private:
  struct Dds;
  std::unique_ptr<Dds> dds_;
};

/// Between bytes and generated types. from_cdr returns false if the bytes are malformed.
CdrBytes to_cdr(const TypeOps& ops, const void* sample);
bool from_cdr(const TypeOps& ops, const CdrBytes& bytes, void* sample);

}  // namespace foretrack
