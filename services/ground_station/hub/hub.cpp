// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/hub.hpp"

#include <algorithm>

#include "services/ground_station/hub/video_chain.hpp"

namespace foretrack::station {
namespace {

constexpr double kLimitShown_s = 2.0;
constexpr double kPictureOld_s = 1.0;
constexpr std::size_t kMostKept = 90;  // three seconds of a video
constexpr std::size_t kMostKeptBytes = 4u << 20;

}  // namespace

Hub::Hub(std::string name, std::string version, const HubLimits& limits)
    : name_(std::move(name)),
      version_(std::move(version)),
      session_id_(std::to_string(now_ns() / 1000000)),
      limits_(limits) {}

void Hub::open(const Channel& channel) {
  channels_[channel.id] = channel;
  const auto text = std::make_shared<const std::string>(foxglove::advertise({channel}));
  for (const auto& [id, client] : clients_) client->tell(text);
}

void Hub::close(std::uint32_t channel) {
  if (channels_.erase(channel) == 0) return;
  flows_.erase(channel);
  const auto text = std::make_shared<const std::string>(foxglove::unadvertise({channel}));
  for (const auto& [id, client] : clients_) {
    if (const auto it = client->by_channel_.find(channel); it != client->by_channel_.end()) {
      client->outbox_.forget(it->second);
      client->by_subscription_.erase(it->second);
      client->by_channel_.erase(it);
    }
    client->tell(text);
  }
}

// A bucket that holds a second's worth, and at least one sample of any size.
bool Hub::within_limit(Flow& flow, std::size_t bytes, double now_s) const {
  if (flow.last_s < 0.0) flow.allowance_bytes = limits_.topic_bytes_s;
  flow.allowance_bytes =
      std::min(limits_.topic_bytes_s,
               flow.allowance_bytes + limits_.topic_bytes_s * std::max(0.0, now_s - flow.last_s));
  flow.last_s = now_s;
  const auto cost = static_cast<double>(bytes);
  if (flow.allowance_bytes < std::min(cost, limits_.topic_bytes_s)) {
    flow.limited_s = now_s;
    return false;
  }
  flow.allowance_bytes -= cost;
  return true;
}

// A video from its last key picture on. One whose keys are too far apart is not kept.
void Hub::keep(Flow& flow, const Channel& channel, const Sample& sample, double now_s) {
  if (!channel.latched && !is_ground_picture(channel)) return;
  if (sample.chain != Chain::kNeedsPrevious) flow.kept.clear(), flow.kept_bytes = 0;
  if (sample.chain == Chain::kNeedsPrevious && flow.kept.empty()) return;
  flow.kept.push_back(sample);
  flow.kept_bytes += sample.data->size();
  flow.kept_s = now_s;
  if (flow.kept.size() > kMostKept || flow.kept_bytes > kMostKeptBytes) flow.kept.clear();
}

// A picture that is old says nothing of now.
std::span<const Sample> Hub::kept(const Channel& channel, double now_s) const {
  const auto it = flows_.find(channel.id);
  if (it == flows_.end()) return {};
  if (!channel.latched && now_s - it->second.kept_s > kPictureOld_s) return {};
  return it->second.kept;
}

void Hub::deliver(const std::vector<Sample>& samples, double now_s) {
  for (const auto& sample : samples) {
    const auto channel = channels_.find(sample.channel);
    if (channel == channels_.end()) continue;
    auto& flow = flows_[sample.channel];
    auto chained = sample;
    chained.chain = chain_of(channel->second, *sample.data);
    keep(flow, channel->second, chained, now_s);
    if (!within_limit(flow, sample.data->size(), now_s)) continue;
    PerLink offered(channel->second, chained);
    for (const auto& [id, client] : clients_) client->offer(offered, now_s);
  }
  for (const auto& [id, client] : clients_) client->flush();
}

void Hub::set_graph(foxglove::Graph graph) {
  const auto news = foxglove::graph_update(graph_, graph);
  graph_ = std::move(graph);
  if (news.empty()) return;
  const auto text = std::make_shared<const std::string>(news);
  for (const auto& [id, client] : clients_)
    if (client->wants_graph_) client->tell(text);
}

std::shared_ptr<Client> Hub::join(std::string address, Link link, double now_s) {
  const auto id = next_client_++;
  auto client = std::make_shared<Client>(*this, id, std::move(address), std::move(link), limits_);
  client->took_s_ = client->spoke_s_ = now_s;
  clients_[id] = client;
  client->tell(foxglove::server_info(name_, session_id_, version_));
  std::vector<Channel> all;
  for (const auto& [channel_id, channel] : channels_) all.push_back(channel);
  client->tell(foxglove::advertise(all));
  return client;
}

void Hub::leave(const Client& client) {
  clients_.erase(client.report_.id);
  if (on_interest) on_interest();
}

void Hub::check(double now_s) {
  auto clients = clients_;  // closing changes the map
  for (const auto& [id, client] : clients) {
    if (client->outbox_.bytes() == 0) client->took_s_ = now_s;
    client->flush();  // what rested
    if (now_s - client->took_s_ > limits_.silent_s)
      client->close("too slow: it took nothing for 10 s");
  }
}

std::set<std::uint32_t> Hub::wanted() const {
  std::set<std::uint32_t> result;
  for (const auto& [id, client] : clients_)
    for (const auto& [channel, subscription] : client->by_channel_) result.insert(channel);
  return result;
}

bool Hub::limited(std::uint32_t channel, double now_s) const {
  const auto it = flows_.find(channel);
  return it != flows_.end() && now_s - it->second.limited_s < kLimitShown_s;
}

std::vector<ClientReport> Hub::clients(double now_s) {
  std::vector<ClientReport> reports;
  for (const auto& [id, client] : clients_) {
    auto report = client->report_;
    report.waiting_bytes = client->outbox_.bytes();
    report.dropped = client->outbox_.dropped();
    report.bytes_s = client->sent_.update(report.sent_bytes, now_s);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace foretrack::station
