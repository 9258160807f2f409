// SPDX-License-Identifier: Apache-2.0
// A bench as files: a table of its flights, and the files themselves.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "services/offline/experiments/summarize.hpp"

namespace foretrack {

/// One line a flight, with its hash and the command that flies it again.
std::string flights_csv_of(const BenchResults& results);

/// "turning/intention-known-2.0-dense_boxes-5001.csv.gz"; a pedestrian has its number at the end.
std::string log_name_of(const FlightJob& job);

/// Text compressed by gzip, without a time stamp. Throws std::runtime_error that names the file.
void write_gzip(const std::filesystem::path& file, std::string_view text);

/// Throws std::runtime_error that names the file. Makes its folder.
void write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace foretrack
