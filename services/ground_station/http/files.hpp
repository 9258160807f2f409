// SPDX-License-Identifier: Apache-2.0
// Files over HTTP: the page's bundle, and recordings with ranges.
#pragma once

#include <filesystem>
#include <string_view>

#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

/// A file of the folder; 404 for what is not in it, links that lead out of it included.
/// `request_path` begins with '/'; "/" is index.html. `cached`: browsers may keep it without
/// asking again. With a Range header, the part that it asks for.
Response serve_file(const std::filesystem::path& folder, std::string_view request_path,
                    std::string_view range, bool cached);

}  // namespace foretrack::station
