// SPDX-License-Identifier: Apache-2.0
// foretrack report: what happened in a recording, as one page.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "services/cli/commands.hpp"
#include "services/ground_station/report/write_report.hpp"

namespace foretrack {
namespace {

struct ReportArguments {
  std::string file, out;
};

int run_report(const ReportArguments& arguments) {
  const auto out = arguments.out.empty()
                       ? std::filesystem::path(arguments.file).replace_extension(".html")
                       : std::filesystem::path(arguments.out);
  const std::string html = station::report_html(station::read_story(arguments.file));
  std::ofstream file(out, std::ios::binary);
  file << html;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + out.string());
  fmt::print("{}\n", out.string());
  return 0;
}

}  // namespace

std::function<int()> prepare_report(CLI::App& app) {
  auto arguments = std::make_shared<ReportArguments>();
  app.add_option("file", arguments->file, "MCAP file")->required()->check(CLI::ExistingFile);
  app.add_option("--out", arguments->out, "HTML file; else beside the recording");
  return [arguments] { return run_report(*arguments); };
}

}  // namespace foretrack
