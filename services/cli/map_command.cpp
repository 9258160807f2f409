// SPDX-License-Identifier: Apache-2.0
// foretrack map: what is in an OctoMap file.
#include <fmt/format.h>

#include <memory>

#include "services/cli/commands.hpp"
#include "services/files/config/octree_world.hpp"

namespace foretrack {
namespace {

std::string line_of(const char* what, const Vec3& min_m, const Vec3& max_m) {
  return fmt::format("{:<10}  x {:.2f} … {:.2f}  y {:.2f} … {:.2f}  z {:.2f} … {:.2f} m\n", what,
                     min_m.x(), max_m.x(), min_m.y(), max_m.y(), min_m.z(), max_m.z());
}

void print_map(const std::string& file) {
  const OctreeSummary map = summarize_octree(file);
  fmt::print("resolution  {:g} m\n", map.resolution_m);
  fmt::print("{}", line_of("known", map.min_m, map.max_m));
  if (!map.occupied_m.isEmpty())
    fmt::print("{}", line_of("occupied", map.occupied_m.min(), map.occupied_m.max()));
  fmt::print("cells       {} occupied, {} free\n", map.occupied_cells, map.free_cells);
}

}  // namespace

std::function<int()> prepare_map(CLI::App& app) {
  const auto file = std::make_shared<std::string>();
  app.add_option("file", *file, "OctoMap file, .bt or .ot")->required();
  return [file] {
    print_map(*file);
    return 0;
  };
}

}  // namespace foretrack
