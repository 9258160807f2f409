// SPDX-License-Identifier: Apache-2.0
#include "services/common/node.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <condition_variable>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "services/common/dds_impl.hpp"
#include "services/common/dds_log.hpp"
#include "services/common/identity.hpp"
#include "services/common/participant.hpp"
#include "services/common/px4_type.hpp"
#include "services/common/ros_graph.hpp"

namespace foretrack {
namespace {

constexpr double kCleanupLimit_s = 2.0;

template <class Pointer>
Pointer not_null(Pointer pointer, const std::string& what) {
  if (!pointer) throw std::runtime_error("DDS refuses to create " + what);
  return pointer;
}

// With what DDS-Security said, or what can be seen of the identity.
std::string no_participant(const NodeOptions& options) {
  const std::string text =
      "DDS refuses to create a participant in domain " + std::to_string(options.domain_id);
  std::string why = security_complaint();
  if (why.empty() && !options.security.empty()) why = refusal_of_identity(options.security);
  return why.empty() ? text : text + ": " + why;
}

void take_down(Node::Dds& node) {
  if (!node.participant) return;
  node.participant->set_listener(nullptr);
  node.participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(node.participant);
  node.participant = nullptr;
}

}  // namespace

Node::Node(const NodeOptions& options)
    : options_(options),
      dds_(std::make_unique<Dds>(*this)),
      wire_(std::make_shared<WireFilter>([this](const std::string& text) { report(text); })) {
  validate_or_throw(options_.names);
  if (!options_.security.empty())
    options_.security = identity_folder(options_.security, options_.service);
  dds_->px4_release = options_.names.px4_release;
  auto* factory = dds::DomainParticipantFactory::get_instance();
  const auto setup = set_up_participant(options_, wire_);
  this_machine_only_ = setup.this_machine_only;
  secured_ = setup.secured;
  if (secured_)
    role_watch_ = std::make_unique<RoleWatch>(
        [this](const std::string& why) { refuse_peer(wire::Fault::kRole, "a peer: " + why); });
  security_complaint();  // what somebody else was told
  dds_->participant = factory->create_participant(options_.domain_id, setup.qos, &dds_->watch,
                                                  dds::StatusMask::none());
  if (!dds_->participant) throw std::runtime_error(no_participant(options_));
  if (const char* unsecured = why_unsecured(); *unsecured)
    spdlog::warn("{}: {}", options_.service, unsecured);
  if (const auto soon = soon_over(options_.security); !soon.empty()) report(soon);
  dds_->publisher =
      not_null(dds_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "a publisher");
  dds_->subscriber =
      not_null(dds_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "a subscriber");
  clock_ = std::make_unique<Clock>(*this, options_.use_sim_time);
}

const char* Node::why_unsecured() const {
  return this_machine_only_ || secured_
             ? ""
             : "DDS reaches other machines and is not secured: whoever is on their network can "
               "order, and be taken for a sensor";
}

Node::~Node() {
  role_watch_.reset();
  run_bounded(kCleanupLimit_s, [this] { take_down(*dds_); });
}

dds::Topic* Node::Dds::topic(const std::string& name, const TypeOps& ops) {
  if (const auto it = topics.find(name); it != topics.end()) return it->second;
  dds::TypeSupport type(Px4Type::is_needed(ops, px4_release) ? new Px4Type(ops, px4_release)
                                                             : new CdrType(ops));
  if (type.register_type(participant) != ReturnCode_t::RETCODE_OK)
    throw std::runtime_error(std::string("DDS refuses type ") + ops.name);
  auto* topic = participant->create_topic(name, ops.name, dds::TOPIC_QOS_DEFAULT);
  topics[name] = not_null(topic, "topic " + name);
  watch.expect(name, ops);
  return topic;
}

WriterCore& Node::add_writer(const TopicInfo& info, const TypeOps& ops) {
  writers_.push_back(std::make_unique<WriterCore>(*this, info, ops));
  return *writers_.back();
}

ReaderCore& Node::add_reader(const TopicInfo& info, const TypeOps& ops) {
  readers_.push_back(std::make_unique<ReaderCore>(*this, info, ops));
  return *readers_.back();
}

void Node::announce() {
  announce_to_ros(*this);
}

void Node::report(const std::string& text) {
  spdlog::warn("{}: {}", options_.service, text);
  const std::lock_guard lock(dds_->error_mutex);
  dds_->last_error = text;
}

std::string Node::last_error() const {
  const std::lock_guard lock(dds_->error_mutex);
  return dds_->last_error;
}

std::vector<ForeignEndpoint> Node::endpoints() const {
  return dds_->watch.all();
}

std::uint64_t Node::discoveries() const {
  return dds_->watch.changes;
}

std::vector<Peer> Node::peers() const {
  return dds_->watch.peers();
}

double Node::lease_s() const {
  const auto& config = dds_->participant->get_qos().wire_protocol().builtin.discovery_config;
  return seconds_of(config.leaseDuration);
}

std::vector<ForeignEndpoint> Node::foreign_endpoints() const {
  return dds_->watch.foreign();
}

void run_bounded(double limit_s, const std::function<void()>& cleanup) {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::thread watchdog([&] {
    std::unique_lock lock(mutex);
    if (changed.wait_for(lock, std::chrono::duration<double>(limit_s), [&] { return done; }))
      return;
    spdlog::error("clean-up of DDS took more than {} s: leaving at once", limit_s);
    spdlog::default_logger()->flush();
    _exit(kCleanupFailed);
  });
  cleanup();
  {
    const std::lock_guard lock(mutex);
    done = true;
  }
  changed.notify_one();
  watchdog.join();
}

}  // namespace foretrack
