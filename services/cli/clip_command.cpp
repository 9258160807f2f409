// SPDX-License-Identifier: Apache-2.0
// foretrack clip: what a vehicle saw in a recording, as a video.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "services/cli/commands.hpp"
#include "services/ground_station/clip/make_clip.hpp"

namespace foretrack {
namespace {

struct ClipArguments {
  std::string file, out;
  station::ClipWish wish;
};

int run_clip(const ClipArguments& arguments) {
  const auto out = arguments.out.empty()
                       ? std::filesystem::path(arguments.file).replace_extension(".webm")
                       : std::filesystem::path(arguments.out);
  const station::Clip clip = station::make_clip(arguments.file, arguments.wish);
  std::ofstream file(out, std::ios::binary);
  file << clip.webm;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + out.string());
  fmt::print("{}: {} pictures of {}, {:.1f} s", out.string(), clip.pictures, clip.vehicle,
             clip.seconds);
  if (clip.left_out > 0)
    fmt::print("; {} left out: broken, of another size, or not later than the one before",
               clip.left_out);
  fmt::print("\n");
  return 0;
}

}  // namespace

std::function<int()> prepare_clip(CLI::App& app) {
  auto arguments = std::make_shared<ClipArguments>();
  app.add_option("file", arguments->file, "MCAP file")->required()->check(CLI::ExistingFile);
  app.add_option("--vehicle", arguments->wish.vehicle, "Whose pictures, where several have some");
  app.add_option("--from", arguments->wish.from_s, "Seconds from the recording's beginning")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--to", arguments->wish.to_s, "The same; else to its end")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--out", arguments->out, "WebM file; else beside the recording");
  return [arguments] { return run_clip(*arguments); };
}

}  // namespace foretrack
