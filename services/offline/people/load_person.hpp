// SPDX-License-Identifier: Apache-2.0
// The people that can be rendered: models by Reallusion (CC-BY 3.0 US), from a Debian package.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/simulator/person_model.hpp"
#include "core/simulator/scenario.hpp"

namespace foretrack {

/// Where the Debian package sweethome3d-furniture puts the models.
inline constexpr char kPeopleFile[] = "/usr/share/sweethome3d/furniture/Reallusion.sh3f";

/// "boy", "girl", "man", …
std::vector<std::string> person_names();

/// A person with textures and a skeleton. `file`: empty for $FORETRACK_PEOPLE, or else kPeopleFile.
/// Throws std::invalid_argument for a name that is none, and std::runtime_error that says which
/// package to install if the models are not there, or what is wrong with them. Cost: about 0.2 s.
std::shared_ptr<const PersonModel> load_person(const std::string& name,
                                               const std::filesystem::path& file = {});

/// Whom the scenario renders; null if it does not.
std::shared_ptr<const PersonModel> person_of(const Scenario& scenario);
/// Its bystanders, in their order; empty if it does not render.
std::vector<std::shared_ptr<const PersonModel>> bystanders_of(const Scenario& scenario);

}  // namespace foretrack
