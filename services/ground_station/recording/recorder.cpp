// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/recorder.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>

#include "core/version.hpp"
#include "services/common/type_hash.hpp"
#include "services/ground_station/mcap/writer.hpp"
#include "services/ground_station/schemas/schemas.hpp"

namespace foretrack::station {
namespace {

constexpr double kChunk_s = 1.0;  // at most so much is lost by a kill

// As rosbag2 has it, in numbers, which every version of it reads.
std::string offered_qos(std::string_view profile) {
  constexpr const char* kForEver = "{sec: 9223372036, nsec: 854775807}";
  const bool latched = profile == "latched" || profile == "log" || profile == "map";
  return fmt::format(
      "- {{history: 1, depth: 10, reliability: {}, durability: {}, deadline: {}, lifespan: {}, "
      "liveliness: 1, liveliness_lease_duration: {}, avoid_ros_namespace_conventions: false}}\n",
      profile == "sensor" ? 2 : 1, latched ? 1 : 2, kForEver, kForEver, kForEver);
}

// What ROS 2 knows, it finds under its own names; what others read live has another form of it.
mcap::ChannelInfo info_of(const Channel& c) {
  mcap::ChannelInfo info{c.topic,
                         c.encoding,
                         c.schema_encoding.empty() ? "" : c.schema_name,
                         c.schema_encoding,
                         c.schema,
                         {{"dds_topic", c.wire}, {"dds_type", c.type}, {"qos_profile", c.profile}}};
  const auto* ros = find_ros_schema(c.type);
  const auto* live = find_schema(c.type);
  if (ros && c.schema == live->text) {  // not of a recording that is of another version
    info.schema_name = ros->name;
    info.schema_encoding = ros->encoding;
    info.schema = ros->text;
    info.metadata["topic_type_hash"] = type_hash_of(c.type);
  }
  if (c.encoding == "cdr") info.metadata["offered_qos_profiles"] = offered_qos(c.profile);
  return info;
}

std::size_t bytes_of(const std::vector<Sample>& samples) {
  std::size_t bytes = 0;
  for (const auto& sample : samples) bytes += sample.data->size();
  return bytes;
}

}  // namespace

/// A file on disk with its writer. A piece that does not fit is taken back.
struct Recorder::File {
  explicit File(const std::filesystem::path& path)
      : fd(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0640)) {
    if (fd >= 0) ::flock(fd, LOCK_EX | LOCK_NB);  // so that nobody takes it for an unfinished one
  }
  ~File() {
    if (fd >= 0) ::close(fd);
  }
  bool append(std::span<const std::uint8_t> piece) {
    std::size_t done = 0;
    while (done < piece.size()) {
      const auto n = ::write(fd, piece.data() + done, piece.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) {
        error = std::strerror(errno);
        if (::ftruncate(fd, static_cast<off_t>(size)) != 0) error += ", and a torn end";
        return false;
      }
      done += static_cast<std::size_t>(n);
    }
    size += piece.size();
    return true;
  }

  int fd;
  std::uint64_t size = 0;
  std::string error;
  std::unique_ptr<mcap::Writer> writer;
  std::map<std::uint32_t, std::uint16_t> ids;  // ours → the file's
  double chunk_since_s = 0.0;
};

Recorder::Recorder(RecorderOptions options) : options_(std::move(options)) {}

Recorder::~Recorder() {
  stop();
}

bool Recorder::wants(const Channel& channel) const {
  if (options_.leave_out && options_.leave_out(channel)) return false;
  return options_.topics.empty() ||
         std::any_of(options_.topics.begin(), options_.topics.end(), [&](const std::string& part) {
           return channel.topic.find(part) != std::string::npos;
         });
}

void Recorder::open(const Channel& channel) {
  const std::lock_guard lock(mutex_);
  if (wants(channel)) channels_[channel.id] = channel;
}

std::set<std::uint32_t> Recorder::wanted() const {
  const std::lock_guard lock(mutex_);
  std::set<std::uint32_t> ids;
  if (recording_)
    for (const auto& [id, channel] : channels_) ids.insert(id);
  return ids;
}

void Recorder::samples(const std::vector<Sample>& samples) {
  const std::lock_guard lock(mutex_);
  for (const auto& sample : samples) {
    const auto channel = channels_.find(sample.channel);
    if (channel != channels_.end() && channel->second.latched) latched_[sample.channel] = sample;
  }
  if (!recording_) return;
  const auto bytes = bytes_of(samples);
  if (queued_bytes_ + bytes > options_.queue_bytes) {
    status_.lost += samples.size();
    return;
  }
  queued_bytes_ += bytes;
  queue_.push_back(samples);
  news_.notify_one();
}

std::filesystem::path Recorder::file_name() const {
  return options_.folder / fmt::format("{}_{:03}.mcap", stem_, part_);
}

bool Recorder::next_file() {
  const auto path = file_name();
  file_ = std::make_unique<File>(path);
  if (file_->fd < 0) {
    const std::lock_guard lock(mutex_);
    fault_ = fmt::format("cannot write {}: {}", path.string(), std::strerror(errno));
    return false;
  }
  ++part_;
  file_->writer = std::make_unique<mcap::Writer>(
      [file = file_.get()](std::span<const std::uint8_t> piece) { return file->append(piece); },
      std::string("foretrack ") + kVersion);
  for (const auto& [name, values] : options_.metadata) file_->writer->add_metadata(name, values);
  const std::lock_guard lock(mutex_);
  status_.file = path.filename().string();
  return true;
}

std::string Recorder::start() {
  if (status()) return "it records already";
  stop();  // joins the thread of a recording that ended by itself
  std::error_code error;
  std::filesystem::create_directories(options_.folder, error);
  stem_ = fmt::format("{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
  part_ = 0;
  while (std::filesystem::exists(file_name(), error)) stem_ += "-again";
  status_ = {};
  fault_.clear();
  if (!next_file()) return fault_;
  {
    const std::lock_guard lock(mutex_);
    recording_ = true;
    stopping_ = false;
    started_s_ = steady_s();
    auto& before = queue_.emplace_back();  // what was said once, before the recording began
    for (const auto& [id, sample] : latched_)
      before.push_back({sample.channel, now_ns(), sample.data});
  }
  thread_ = std::thread([this] { write_all(); });
  return {};
}

void Recorder::end() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  news_.notify_one();
}

void Recorder::stop() {
  end();
  if (thread_.joinable()) thread_.join();
}

void Recorder::write(const std::vector<Sample>& samples) {
  for (const auto& sample : samples) {
    auto& id = file_->ids[sample.channel];
    if (id == 0) {
      const std::lock_guard lock(mutex_);
      const auto channel = channels_.find(sample.channel);
      if (channel == channels_.end()) continue;
      id = file_->writer->add_channel(info_of(channel->second));
    }
    if (file_->writer->pending_bytes() == 0) file_->chunk_since_s = steady_s();
    file_->writer->write(id, static_cast<std::uint64_t>(sample.log_time_ns), *sample.data);
  }
}

void Recorder::write_all() {
  std::uint64_t before_bytes = 0;  // of files that are full
  bool last = false;
  bool open = true;
  // Before each batch, not once for all that waits: files keep to their size under any load.
  const auto write_batch = [&](const std::vector<Sample>& batch) {
    if (file_->writer->bytes() >= options_.split_bytes) {
      file_->writer->finish();
      before_bytes += file_->size;
      if (!next_file()) return false;
    }
    write(batch);
    return true;
  };
  while (!last && file_->writer->good()) {
    std::deque<std::vector<Sample>> batches;
    {
      std::unique_lock lock(mutex_);
      news_.wait_for(lock, std::chrono::duration<double>(kChunk_s / 4),
                     [&] { return stopping_ || !queue_.empty(); });
      batches.swap(queue_);
      queued_bytes_ = 0;
      last = stopping_;
      status_.bytes = before_bytes + file_->size;
    }
    for (std::size_t i = 0; open && i < batches.size(); ++i) open = write_batch(batches[i]);
    if (!open) break;
    auto& writer = *file_->writer;
    if (writer.pending_bytes() > 0 && steady_s() - file_->chunk_since_s > kChunk_s) writer.flush();
  }
  if (file_->writer) file_->writer->finish();
  const std::lock_guard lock(mutex_);
  if (!file_->error.empty()) fault_ = "the recording ended: " + file_->error;
  recording_ = false;
  queue_.clear();
  queued_bytes_ = 0;
}

std::optional<RecordingStatus> Recorder::status() const {
  const std::lock_guard lock(mutex_);
  if (!recording_) return std::nullopt;
  auto status = status_;
  status.seconds = steady_s() - started_s_;
  return status;
}

std::string Recorder::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

std::map<std::string, std::map<std::string, std::string>> recording_metadata(
    const std::string& parameters) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  std::map<std::string, std::map<std::string, std::string>> metadata;
  metadata["foretrack"] = {{"version", kVersion}, {"host", host}};
  if (!parameters.empty()) metadata["parameters"] = {{"yaml", parameters}};
  return metadata;
}

}  // namespace foretrack::station
