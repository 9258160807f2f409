// SPDX-License-Identifier: Apache-2.0
// Parameter files: one YAML with a section per stage, differences from the defaults only.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/tracker/tracker.hpp"

namespace foretrack {

/// The stages with their rows, in the order of the pipeline: tracker, perception, mapping,
/// prediction, planning, safety, ground_stream. Valid as long as the params are.
std::vector<std::pair<std::string_view, ParamRows>> stages_of(TrackerParams& params);

/// The parameter file of that name, or of a shipped one (deploy/params/NAME.yaml). Throws
/// std::invalid_argument that lists those that ship.
std::string find_params(const std::string& name_or_file);

/// Defaults with the file's values. Throws std::invalid_argument that names every fault (unknown
/// stage or key, bad text, NaN, out of range) with file and line.
TrackerParams load_params(const std::string& file);

/// A table of the stage's rows (name, value, unit, range, meaning); every stage if empty. Throws
/// std::invalid_argument that lists the stages if there is no such stage.
std::string describe_params(TrackerParams& params, std::string_view stage = {});

/// The same as Markdown: a heading and a table for each stage.
std::string markdown_of_params(TrackerParams& params, std::string_view stage = {});

/// The stage's rows as a parameter file would have them; every stage if empty.
std::string yaml_of_params(TrackerParams& params, std::string_view stage = {});

}  // namespace foretrack
