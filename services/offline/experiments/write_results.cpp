// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/write_results.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <fstream>
#include <memory>
#include <stdexcept>

namespace foretrack {
namespace {

namespace fs = std::filesystem;

void make_folder_of(const fs::path& file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    throw std::runtime_error(
        fmt::format("cannot make {}: {}", file.parent_path().string(), error.message()));
}

}  // namespace

std::string flights_csv_of(const BenchResults& r) {
  std::string text =
      "experiment,method,map,target_speed_m_s,world,seed,events,successes,failure_rate,"
      "occlusion_rate,fov_loss_rate,near_rate,band_share,min_distance_m,min_clearance_m,"
      "collisions,log_sha256,command\n";
  for (std::size_t i = 0; i < r.jobs.size(); ++i) {
    const FlightJob& job = r.jobs[i];
    const RunRecord& record = r.records[i];
    const Metrics& m = record.metrics;
    int successes = 0;
    for (const EventOutcome& e : record.events) successes += e.success;
    text += fmt::format(
        "{},{},{},{:g},{},{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{},{},\"{}\"\n",
        job.cell.experiment, job.cell.method, to_string(job.cell.map), job.cell.target_speed_m_s,
        job.world, *job.overrides.seed, record.events.size(), successes, m.failure_rate,
        m.occlusion_rate, m.fov_loss_rate, m.near_rate, m.band_share, m.min_distance_m,
        m.min_clearance_m, m.collisions, record.log_sha256, job.command);
  }
  return text;
}

std::string log_name_of(const FlightJob& job) {
  std::string name = fmt::format("{}/{}-{}-{:.1f}-{}-{}", job.cell.experiment, job.cell.method,
                                 to_string(job.cell.map), job.cell.target_speed_m_s,
                                 fs::path(job.world).stem().string(), *job.overrides.seed);
  if (job.overrides.pedestrian)
    name += fmt::format("-{}-{}", fs::path(*job.overrides.track_file).stem().string(),
                        *job.overrides.pedestrian);
  return name + ".csv.gz";
}

void write_gzip(const fs::path& file, std::string_view text) {
  make_folder_of(file);
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(file.c_str(), "wb6"), &gzclose);
  const auto size = static_cast<unsigned>(text.size());
  if (!out || gzwrite(out.get(), text.data(), size) != static_cast<int>(size))
    throw std::runtime_error("cannot write " + file.string());
}

void write_text(const fs::path& file, std::string_view text) {
  make_folder_of(file);
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace foretrack
