// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_params.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "services/files/share/share.hpp"
#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {
namespace {

using Stages = std::vector<std::pair<std::string_view, ParamRows>>;

std::string names_of(const Stages& stages) {
  std::string names;
  for (const auto& [name, rows] : stages) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  return names;
}

Stages chosen(TrackerParams& params, std::string_view stage) {
  Stages stages = stages_of(params);
  if (stage.empty()) return stages;
  for (auto& entry : stages)
    if (entry.first == stage) return {std::move(entry)};
  throw std::invalid_argument(
      fmt::format("no stage '{}'; the stages are {}", stage, names_of(stages)));
}

void read_stage(const YAML::Node& section, std::string_view stage, const ParamRows& rows,
                Faults& faults) {
  if (section.IsNull()) return;
  if (!section.IsMap())
    return faults.add(section.Mark(),
                      fmt::format("{}: expected a mapping of keys to values", stage));
  for (const auto& entry : section) {
    const std::string key = entry.first.Scalar();
    const std::string value = entry.second.IsScalar() ? entry.second.Scalar() : std::string();
    const std::string fault = set_param(rows, key, value);
    if (!fault.empty()) faults.add(entry.first.Mark(), fmt::format("{}.{}", stage, fault));
  }
}

std::string range_of(const ParamRow& row) {
  if (std::holds_alternative<bool*>(row.value))
    return row.unit.find('|') == std::string_view::npos ? "true, false" : std::string(row.unit);
  return fmt::format("{:g} … {:g}", row.min, row.max);
}

}  // namespace

Stages stages_of(TrackerParams& params) {
  return {{"perception", rows(params.perception)},
          {"mapping", rows(params.mapping)},
          {"bodies", rows(params.bodies)},
          {"choice", rows(params.choice)},
          {"prediction", rows(params.prediction)},
          {"planning", rows(params.planning)},
          {"safety", rows(params.safety)},
          {"ground_stream", rows(params.ground_stream)},
          {"fleet", rows(params.fleet)}};
}

std::string find_params(const std::string& name_or_file) {
  namespace fs = std::filesystem;
  if (fs::is_regular_file(name_or_file)) return name_or_file;
  std::vector<std::string> names;
  for (const auto& folder : share_folders()) {
    const fs::path shipped = folder / "deploy" / "params" / (name_or_file + ".yaml");
    if (fs::is_regular_file(shipped)) return shipped.string();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / "deploy" / "params", error))
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  throw std::invalid_argument(fmt::format("no parameter file or name '{}'; shipped are {}",
                                          name_or_file, fmt::join(names, ", ")));
}

TrackerParams load_params(const std::string& file) {
  TrackerParams params;
  const Stages stages = stages_of(params);
  Faults faults(file);
  const YAML::Node document = load_yaml(file);
  if (!document.IsMap() && !document.IsNull())
    faults.add(document.Mark(), "expected a mapping of stages: " + names_of(stages));
  if (document.IsMap())
    for (const auto& section : document) {
      const std::string name = section.first.Scalar();
      const auto stage = std::find_if(stages.begin(), stages.end(),
                                      [&](const auto& entry) { return entry.first == name; });
      if (stage == stages.end())
        faults.add(section.first.Mark(),
                   fmt::format("{}: unknown stage; the stages are {}", name, names_of(stages)));
      else
        read_stage(section.second, name, stage->second, faults);
    }
  faults.throw_if_any();
  return params;
}

std::string describe_params(TrackerParams& params, std::string_view stage) {
  std::string text;
  for (const auto& [name, stage_rows] : chosen(params, stage)) {
    std::size_t widest = 4;
    for (const auto& row : stage_rows) widest = std::max(widest, row.name.size());
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", name);
    for (const auto& row : stage_rows)
      text += fmt::format("  {:<{}}  {:>10} {:<10} {:<16} {}\n", row.name, widest, text_of(row),
                          row.unit, range_of(row), row.meaning);
  }
  return text;
}

std::string markdown_of_params(TrackerParams& params, std::string_view stage) {
  std::string text;
  for (const auto& [name, stage_rows] : chosen(params, stage)) {
    text += fmt::format(
        "## {}\n\n| name | default | unit | range | meaning |\n|---|---|---|---|---|\n", name);
    for (const auto& row : stage_rows)
      text += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.name, text_of(row), row.unit,
                          range_of(row), row.meaning);
    text += '\n';
  }
  return text;
}

std::string yaml_of_params(TrackerParams& params, std::string_view stage) {
  std::string text;
  for (const auto& [name, stage_rows] : chosen(params, stage)) {
    text += fmt::format("{}:\n", name);
    for (const auto& row : stage_rows)
      text += fmt::format("  {}: {}  # {}{}{}\n", row.name, text_of(row), row.unit,
                          row.unit.empty() ? "" : "; ", row.meaning);
  }
  return text;
}

}  // namespace foretrack
