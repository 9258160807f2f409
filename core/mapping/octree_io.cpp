// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/octree_io.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/mapping/octree_cells.hpp"

namespace foretrack {
namespace {

using Vec3i = Eigen::Vector3i;

constexpr double kMostCells = 1e8;

// Length of the node's bytes with all below it, 0 if they end too early or go too deep. OctoMap
// itself does not check, and reads on for ever.
std::size_t node_length(std::string_view bytes, int depth) {
  if (bytes.size() < 2 || depth >= kTreeDepth) return 0;
  std::size_t length = 2;
  for (int child = 0; child < 8; ++child) {
    const int pair = static_cast<unsigned char>(bytes[child / 4]) >> (2 * (child % 4)) & 3;
    if (pair != 3) continue;  // not known, or a leaf
    const std::size_t below = node_length(bytes.substr(length), depth + 1);
    if (below == 0) return 0;
    length += below;
  }
  return length;
}

// The same of a full tree (.ot): four bytes of log-odds and one of children a node. 0 also if the
// log-odds are no number.
std::size_t full_node_length(std::string_view bytes, int depth) {
  constexpr std::size_t kNode = sizeof(float) + 1;
  float log_odds = 0.0F;
  if (bytes.size() < kNode || depth > kTreeDepth) return 0;
  std::memcpy(&log_odds, bytes.data(), sizeof log_odds);
  if (!std::isfinite(log_odds)) return 0;
  const auto children = static_cast<unsigned char>(bytes[sizeof log_odds]);
  std::size_t length = kNode;
  for (int child = 0; child < 8; ++child) {
    if ((children >> child & 1) == 0) continue;
    const std::size_t below = full_node_length(bytes.substr(length), depth + 1);
    if (below == 0) return 0;
    length += below;
  }
  return length;
}

std::unique_ptr<octomap::OcTree> full_octree_from_bytes(const std::string& bytes,
                                                        double resolution_m) {
  auto tree = std::make_unique<octomap::OcTree>(resolution_m);
  if (bytes.empty()) return tree;
  if (full_node_length(bytes, 0) != bytes.size())
    throw std::invalid_argument("octree: the bytes are not exactly one octree");
  std::istringstream stream(bytes);
  tree->readData(stream);
  return tree;
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::invalid_argument("map " + path + ": " + what);
}

struct Header {
  double resolution_m = 0.0;
  bool full = false;
};

// The lines before the nodes: `id`, `res`, comments, `data`.
Header read_header(std::istream& file, const std::string& path) {
  constexpr std::string_view kBinary = "# Octomap OcTree binary file",
                             kFull = "# Octomap OcTree file";
  std::string line, id;
  double resolution_m = 0.0;
  if (!std::getline(file, line) || (line != kBinary && line != kFull))
    fail(path, "is not an OctoMap file (.bt or .ot)");
  const bool full = line == kFull;
  while (std::getline(file, line) && line != "data") {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "id") words >> id;
    if (word == "res") words >> resolution_m;
  }
  if (id != "OcTree") fail(path, "holds a '" + id + "', expected an 'OcTree'");
  if (!(resolution_m > 0.0)) fail(path, "has no resolution");
  return {resolution_m, full};
}

}  // namespace

std::string octree_bytes(const octomap::OcTree& tree) {
  std::ostringstream stream;
  tree.writeBinaryData(stream);
  return std::move(stream).str();
}

std::unique_ptr<octomap::OcTree> octree_from_bytes(std::string_view bytes, double resolution_m) {
  if (!(resolution_m > 0.0) || !std::isfinite(resolution_m))
    throw std::invalid_argument("octree: resolution must be above 0 m");
  auto tree = std::make_unique<octomap::OcTree>(resolution_m);
  if (bytes.empty()) return tree;
  if (node_length(bytes, 0) != bytes.size())
    throw std::invalid_argument("octree: the bytes are not exactly one octree");
  std::istringstream stream{std::string(bytes)};
  tree->readBinaryData(stream);
  return tree;
}

std::unique_ptr<octomap::OcTree> read_octree(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "cannot be opened");
  const auto [resolution_m, full] = read_header(file, path);
  std::ostringstream bytes;
  if (file.peek() != std::ifstream::traits_type::eof()) bytes << file.rdbuf();
  try {
    return full ? full_octree_from_bytes(std::move(bytes).str(), resolution_m)
                : octree_from_bytes(std::move(bytes).str(), resolution_m);
  } catch (const std::invalid_argument& error) {
    fail(path, error.what());
  }
}

void write_octree(const octomap::OcTree& tree, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "# Octomap OcTree binary file\n# (feel free to add / change comments)\n"
       << "id OcTree\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n"
       << octree_bytes(tree);
  if (!file.flush()) fail(path, "cannot be written");
}

GridMap grid_of_octree(const octomap::OcTree& tree, const Vec3& low_enu_m, const Vec3& high_enu_m) {
  const double resolution_m = tree.getResolution();
  // A bound on a face of a cell may be off by rounding.
  const Vec3 low = (low_enu_m / resolution_m).array() + 1e-6;
  const Vec3 high = (high_enu_m / resolution_m).array() - 1e-6;
  const bool is_box = (high.array() > low.array()).all() && low.allFinite() && high.allFinite();
  if (!is_box || (high - low).prod() > kMostCells || low.minCoeff() < -kTreeCentre ||
      high.maxCoeff() > kTreeCentre)
    throw std::invalid_argument("grid of an octree: the box is empty or too large");
  const Vec3i first = low.array().floor().cast<int>();
  GridMap map;
  map.resolution_m = resolution_m;
  map.origin_enu_m = first.cast<double>() * resolution_m;
  map.size = high.array().ceil().cast<int>().matrix() - first;
  map.cells.assign(map.cell_count(), static_cast<std::uint8_t>(Cell::kUnknown));
  for_each_leaf(
      tree, first, first + map.size, [&](bool occupied, const Vec3i& from, const Vec3i& to) {
        const auto value = static_cast<std::uint8_t>(occupied ? Cell::kOccupied : Cell::kFree);
        for (int z = from.z(); z < to.z(); ++z)
          for (int y = from.y(); y < to.y(); ++y)
            std::fill_n(map.cells.begin() + map.offset_of({from.x(), y, z}), to.x() - from.x(),
                        value);
      });
  DistanceWorkspace workspace;
  update_distances(map, workspace);
  return map;
}

GridMap grid_of_octree(const octomap::OcTree& tree) {
  Vec3 low, high;
  tree.getMetricMin(low.x(), low.y(), low.z());
  tree.getMetricMax(high.x(), high.y(), high.z());
  return grid_of_octree(tree, low, high);
}

}  // namespace foretrack
