// SPDX-License-Identifier: Apache-2.0
#include "services/offline/people/read_obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace foretrack {
namespace {

using Vec3f = Eigen::Vector3f;

std::string_view next_word(std::string_view& line) {
  const auto begin = std::min(line.find_first_not_of(" \t\r"), line.size());
  line.remove_prefix(begin);
  const auto end = std::min(line.find_first_of(" \t\r"), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

// What comes before the separator, which is cut off with it.
std::string_view cut(std::string_view& text, char separator) {
  const auto end = text.find(separator);
  const std::string_view first = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return first;
}

template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  for (int number = 1; !text.empty(); ++number) visit(cut(text, '\n'), number);
}

template <class Number>
bool parse(std::string_view word, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

// One OBJ, line by line.
struct Reader {
  PersonMesh mesh;
  std::vector<std::string>& materials;
  std::vector<Vec3f> positions, normals;
  std::vector<Eigen::Vector2f> pictures;
  std::map<std::array<int, 3>, int> known;  // place/picture/normal → vertex
  int material = 0;
  int line_number = 0;

  [[noreturn]] void fail(const char* what) const {
    throw std::runtime_error(fmt::format("OBJ line {}: {}", line_number, what));
  }
  float number(std::string_view& line) const {
    float value = 0.0F;
    if (!parse(next_word(line), value) || !std::isfinite(value)) fail("a number is expected");
    return value;
  }
  Vec3f point(std::string_view& line) const {
    const float x = number(line), y = number(line), z = number(line);
    return {z, x, y};
  }
  // 1 is the first, −1 the last.
  int index(std::string_view word, std::size_t count) const {
    int i = 0;
    if (!parse(word, i)) fail("an index is expected");
    i = i < 0 ? i + static_cast<int>(count) : i - 1;
    if (i < 0 || i >= static_cast<int>(count)) fail("an index is out of range");
    return i;
  }
  int vertex(std::string_view word) {
    std::array<std::string_view, 3> parts;
    for (auto& part : parts) part = cut(word, '/');
    std::array<int, 3> key = {index(parts[0], positions.size()), -1, -1};
    if (!parts[1].empty()) key[1] = index(parts[1], pictures.size());
    if (!parts[2].empty()) key[2] = index(parts[2], normals.size());
    const auto [found, is_new] = known.emplace(key, static_cast<int>(mesh.vertices.size()));
    if (is_new) {
      PersonMesh::Vertex& v = mesh.vertices.emplace_back();
      v.position = positions[key[0]];
      if (key[1] >= 0) v.u = pictures[key[1]].x(), v.v = pictures[key[1]].y();
      if (key[2] >= 0) v.normal = normals[key[2]].stableNormalized();
    }
    return found->second;
  }
  void face(std::string_view line) {
    std::vector<int> corners;
    for (auto word = next_word(line); !word.empty(); word = next_word(line))
      corners.push_back(vertex(word));
    if (corners.size() < 3) fail("a face needs three corners");
    for (std::size_t i = 2; i < corners.size(); ++i)
      mesh.triangles.push_back({{corners[0], corners[i - 1], corners[i]}, material});
  }
  void use(std::string_view name) {
    const auto found = std::find(materials.begin(), materials.end(), name);
    material = static_cast<int>(found - materials.begin());
    if (found == materials.end()) materials.emplace_back(name);
  }
  void read(std::string_view line) {
    const std::string_view word = next_word(line);
    if (word == "v") positions.push_back(point(line));
    if (word == "vn") normals.push_back(point(line));
    if (word == "vt") {
      const float u = number(line), v = number(line);
      pictures.emplace_back(u, v);
    }
    if (word == "usemtl") use(next_word(line));
    if (word == "f") face(line);
  }
};

}  // namespace

std::map<std::string, Material> read_mtl(std::string_view text) {
  std::map<std::string, Material> materials;
  Material* current = nullptr;
  for_each_line(text, [&](std::string_view line, int) {
    const std::string_view word = next_word(line);
    if (word == "newmtl") current = &materials[std::string(next_word(line))];
    if (current && word == "map_Kd") current->picture = next_word(line);
    if (current && word == "Kd")
      for (float& channel : current->color) parse(next_word(line), channel);
  });
  return materials;
}

PersonMesh read_obj(std::string_view text, std::vector<std::string>& materials) {
  Reader reader{.mesh = {},
                .materials = materials,
                .positions = {},
                .normals = {},
                .pictures = {},
                .known = {}};
  for_each_line(text, [&](std::string_view line, int number) {
    reader.line_number = number;
    reader.read(line);
  });
  if (materials.empty()) materials.emplace_back();
  return std::move(reader.mesh);
}

}  // namespace foretrack
