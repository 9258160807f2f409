// SPDX-License-Identifier: Apache-2.0
#include "services/cli/vehicle_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {
namespace {

// What is of a command line alone.
constexpr std::array<std::string_view, 4> kNoKeys = {"help", "config", "print-params",
                                                     "no-mapping"};

std::string key_of(std::string option) {
  std::ranges::replace(option, '-', '_');
  return option;
}

std::string keys_of(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options())
    for (const auto& name : option->get_lnames())
      if (std::ranges::find(kNoKeys, name) == kNoKeys.end())
        text += fmt::format("{}{}", text.empty() ? "" : ", ", key_of(name));
  return text;
}

CLI::Option* find_option(CLI::App& app, std::string key) {
  std::ranges::replace(key, '_', '-');
  if (std::ranges::find(kNoKeys, key) != kNoKeys.end()) return nullptr;
  return app.get_option_no_throw("--" + key);
}

std::vector<std::string> words_of(const YAML::Node& value) {
  if (!value.IsSequence()) return {value.as<std::string>("")};
  std::vector<std::string> words;
  for (const auto& word : value) words.push_back(word.as<std::string>(""));
  return words;
}

void take_value(CLI::Option& option, const YAML::Node& value, Faults& faults) {
  if (option.count() > 0) return;  // said elsewhere
  if (value.IsMap() || value.IsNull())
    return faults.add(value.Mark(), option.get_name() + ": a value is expected");
  try {
    option.add_result(words_of(value));
    option.run_callback();
  } catch (const CLI::Error& error) {
    faults.add(value.Mark(), error.what());
  }
}

}  // namespace

void take_vehicle_file(CLI::App& app, const std::string& file, OtherKeys others) {
  if (file.empty()) return;
  const YAML::Node document = load_yaml(file);
  Faults faults(file);
  if (!document.IsMap() && !document.IsNull())
    faults.add(document.Mark(), "keys and values are expected, as domain: 7");
  for (const auto& entry : document) {
    const auto key = entry.first.as<std::string>("");
    if (CLI::Option* option = find_option(app, key))
      take_value(*option, entry.second, faults);
    else if (others == OtherKeys::kRefused)
      faults.add(entry.first.Mark(), fmt::format("'{}' is none of {}", key, keys_of(app)));
  }
  faults.throw_if_any();
}

}  // namespace foretrack
