// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ and MTL: as much of them as textured people need.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulator/person_model.hpp"

namespace foretrack {

struct Material {
  Eigen::Vector3f color = Eigen::Vector3f::Ones();  // Kd
  std::string picture;                              // map_Kd; empty: only the colour
};
std::map<std::string, Material> read_mtl(std::string_view text);

/// The polygons in triangles. OBJ's axes (x to the person's left, y up, z forward) become the
/// body's. `materials`: names in the order of the triangles' textures. Throws std::runtime_error
/// that names the line of what is no OBJ.
PersonMesh read_obj(std::string_view text, std::vector<std::string>& materials);

}  // namespace foretrack
