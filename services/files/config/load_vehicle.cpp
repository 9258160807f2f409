// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_vehicle.hpp"

#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {

VehicleSection load_vehicle(const std::string& file) {
  VehicleSection section;
  const YAML::Node document = load_yaml(file);
  if (!document.IsMap() || !document["vehicle"]) return section;
  Faults faults(file);
  YamlReader r(document["vehicle"], "vehicle", faults);
  r.texts("remap", section.remaps);
  r.texts("preset", section.presets);
  r.text("px4", section.px4);
  r.text("px4_namespace", section.px4_namespace);
  r.text("base_frame", section.base_frame);
  if (r.has("odometry_is_map")) r.flag("odometry_is_map", section.odometry_is_map.emplace());
  r.numbers("color_mount", section.color_mount, 6);
  r.numbers("depth_mount", section.depth_mount, 6);
  r.finish();
  faults.throw_if_any();
  return section;
}

}  // namespace foretrack
