// SPDX-License-Identifier: Apache-2.0
// What the doctor has to say of one link of the chain.
#pragma once

#include <string>
#include <string_view>

namespace foretrack {

struct Finding {
  enum class Level { kFine, kNote, kFault };
  Level level = Level::kFine;
  std::string stage;   // "vehicle", "camera", "target", "map", … or "set-up"
  std::string text;    // one sentence, plain words
  std::string advice;  // what to do; may be empty
};

inline Finding fine(std::string_view stage, std::string text) {
  return {Finding::Level::kFine, std::string(stage), std::move(text), ""};
}
inline Finding note(std::string_view stage, std::string text, std::string advice = "") {
  return {Finding::Level::kNote, std::string(stage), std::move(text), std::move(advice)};
}
inline Finding fault(std::string_view stage, std::string text, std::string advice = "") {
  return {Finding::Level::kFault, std::string(stage), std::move(text), std::move(advice)};
}

}  // namespace foretrack
