// SPDX-License-Identifier: Apache-2.0
// What is said of bad arguments.
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>
#include <utility>

namespace foretrack {

/// The words with which it is refused; "no error": it is not.
template <std::invocable Act>
std::string error_of(Act&& act) {
  try {
    static_cast<void>(std::forward<Act>(act)());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace foretrack
