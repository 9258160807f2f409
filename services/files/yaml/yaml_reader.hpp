// SPDX-License-Identifier: Apache-2.0
// Reads YAML that users write: every fault with its file, line and key, all of them at once.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/common/geometry.hpp"

namespace foretrack {

/// The faults found so far in one file.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}
  void add(const YAML::Mark& mark, const std::string& text);
  bool empty() const { return lines_.empty(); }
  /// Throws std::invalid_argument with one line per fault, if there is one.
  void throw_if_any() const;

 private:
  std::string file_;
  std::vector<std::string> lines_;
};

/// The document. Throws std::invalid_argument, naming file and line, if it cannot be read or
/// parsed, is not the only one in its file, or has a key twice in one mapping.
YAML::Node load_yaml(const std::filesystem::path& file);

/// One mapping of a document. A key that is missing leaves the value as it is; a value of another
/// kind or out of range is a fault. Call finish() last: keys that nobody asked for are faults too.
class YamlReader {
 public:
  /// `name`: the mapping's own key, for messages; empty for the document.
  YamlReader(const YAML::Node& node, std::string name, Faults& faults);

  bool has(std::string_view key);
  void number(std::string_view key, double& value, double min, double max);
  void integer(std::string_view key, int& value, int min, int max);
  void seed(std::string_view key, std::uint64_t& value);
  void flag(std::string_view key, bool& value);
  void text(std::string_view key, std::string& value);
  /// A list of texts, or one alone.
  void texts(std::string_view key, std::vector<std::string>& values);
  /// A list of lists of texts.
  void lists(std::string_view key, std::vector<std::vector<std::string>>& values);
  /// The index of the word in `choices`.
  void choice(std::string_view key, std::span<const std::string_view> choices, int& value);
  void point(std::string_view key, Vec2& value);
  void point(std::string_view key, Vec3& value);
  /// Exactly n finite numbers.
  bool numbers(std::string_view key, std::vector<double>& values, std::size_t n);
  void points(std::string_view key, std::vector<Vec2>& values);
  /// Calls read for the mapping, or each mapping of the list, under the key; then finishes it.
  void section(std::string_view key, const std::function<void(YamlReader&)>& read);
  void list(std::string_view key, const std::function<void(YamlReader&)>& read);
  /// A fault of this key's value.
  void fault(std::string_view key, const std::string& text);
  void finish();

 private:
  YAML::Node take(std::string_view key);
  std::vector<std::string> texts_of(std::string_view key, const YAML::Node& list);
  std::string path_of(std::string_view key) const;

  YAML::Node node_;
  std::string name_;
  Faults& faults_;
  std::vector<std::string> asked_;
};

}  // namespace foretrack
