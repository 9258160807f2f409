// SPDX-License-Identifier: Apache-2.0
// main() of a bench: options, then the work; what goes wrong is said, not dumped.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>

namespace foretrack {

template <class Work>
int run_bench(CLI::App& app, int argc, char** argv, Work work) {
  CLI11_PARSE(app, argc, argv);
  try {
    return work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace foretrack
