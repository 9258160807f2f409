// SPDX-License-Identifier: Apache-2.0
#include "services/files/yaml/yaml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace foretrack {
namespace {

std::string kind_of(const YAML::Node& node) {
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a mapping";
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  return "nothing";
}

bool to_number(const YAML::Node& node, double& value) {
  if (!node.IsScalar()) return false;
  return YAML::convert<double>::decode(node, value) && std::isfinite(value);
}

bool to_numbers(const YAML::Node& node, std::size_t n, std::vector<double>& values) {
  if (!node.IsSequence() || node.size() != n) return false;
  values.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    if (!to_number(node[i], values[i])) return false;
  return true;
}

constexpr int kMostDepth = 32;
constexpr int kMostNodes = 1'000'000;  // with those that aliases repeat

// YAML forbids a key twice in a mapping; yaml-cpp takes the first. Bounded, as aliases can lead
// back.
void check_keys(const YAML::Node& node, const std::string& path, int depth, int& left,
                Faults& faults) {
  if (depth > kMostDepth || --left < 0)
    return faults.add(node.Mark(), fmt::format("{}: deeper or longer than files are", path));
  if (node.IsSequence())
    for (std::size_t i = 0; i < node.size() && left > 0; ++i)
      check_keys(node[i], fmt::format("{}[{}]", path, i), depth + 1, left, faults);
  if (!node.IsMap()) return;
  std::vector<std::string> seen;
  for (const auto& entry : node) {
    if (left <= 0) return;
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : std::string();
    const std::string place = path.empty() ? key : path + "." + key;
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      faults.add(entry.first.Mark(), place + ": given twice");
    seen.push_back(key);
    check_keys(entry.second, place, depth + 1, left, faults);
  }
}

// How many documents there are, empty ones at the end apart, and where the second begins. The
// library finds new ones for ever in some texts that are not YAML, so no more are asked for.
class Documents : public YAML::EventHandler {
 public:
  static constexpr int kMost = 8;

  int count = 0;
  YAML::Mark second;

  void OnDocumentStart(const YAML::Mark& /*mark*/) override { ++begun_; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { note(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {
    note(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/,
                       YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value /*style*/) override {
    note(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    note(mark);
  }
  void OnMapEnd() override {}

 private:
  void note(const YAML::Mark& mark) {
    if (begun_ > 1 && count < 2) second = mark;
    count = begun_;
  }

  int begun_ = 0;
};

Documents count_documents(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Documents documents;
  for (int i = 0; i < Documents::kMost && parser.HandleNextDocument(documents); ++i) {
  }
  return documents;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw YAML::BadFile(file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

void Faults::add(const YAML::Mark& mark, const std::string& text) {
  lines_.push_back(mark.line < 0 ? fmt::format("{}: {}", file_, text)
                                 : fmt::format("{}:{}: {}", file_, mark.line + 1, text));
}

void Faults::throw_if_any() const {
  if (!lines_.empty()) throw std::invalid_argument(fmt::format("{}", fmt::join(lines_, "\n")));
}

YAML::Node load_yaml(const std::filesystem::path& file) {
  try {
    const std::string text = text_of(file);
    const Documents documents = count_documents(text);
    const YAML::Node document = YAML::Load(text);
    Faults faults(file.string());
    if (documents.count > 1)
      faults.add(documents.second,
                 fmt::format("{} documents (divided by ---), one expected", documents.count));
    int left = kMostNodes;
    check_keys(document, "", 0, left, faults);
    faults.throw_if_any();
    return document;
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument(file.string() + ": cannot be read");
  } catch (const YAML::ParserException& error) {
    throw std::invalid_argument(
        fmt::format("{}:{}: not YAML: {}", file.string(), error.mark.line + 1, error.msg));
  }
}

YamlReader::YamlReader(const YAML::Node& node, std::string name, Faults& faults)
    : node_(node), name_(std::move(name)), faults_(faults) {
  if (node_.IsMap() || node_.IsNull()) return;
  faults_.add(node_.Mark(), fmt::format("{}: is {}, expected a mapping of keys to values",
                                        name_.empty() ? "the document" : name_, kind_of(node_)));
  node_ = YAML::Node();
}

std::string YamlReader::path_of(std::string_view key) const {
  return name_.empty() ? std::string(key) : name_ + "." + std::string(key);
}

YAML::Node YamlReader::take(std::string_view key) {
  asked_.emplace_back(key);
  if (!node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  const YAML::Node& node = node_;  // const: looking up does not insert
  return node[std::string(key)];
}

bool YamlReader::has(std::string_view key) {
  const YAML::Node value = take(key);
  return value.IsDefined() && !value.IsNull();
}

void YamlReader::fault(std::string_view key, const std::string& text) {
  const YAML::Node value = take(key);
  faults_.add(value.IsDefined() ? value.Mark() : node_.Mark(), path_of(key) + ": " + text);
}

void YamlReader::number(std::string_view key, double& value, double min, double max) {
  if (!has(key)) return;
  double found = 0.0;
  if (!to_number(take(key), found) || found < min || found > max)
    return fault(key,
                 fmt::format("is {}, expected a number in [{}, {}]", kind_of(take(key)), min, max));
  value = found;
}

void YamlReader::integer(std::string_view key, int& value, int min, int max) {
  if (!has(key)) return;
  double found = 0.0;
  if (!to_number(take(key), found) || found != std::floor(found) || found < min || found > max)
    return fault(key, fmt::format("is {}, expected a whole number in [{}, {}]", kind_of(take(key)),
                                  min, max));
  value = static_cast<int>(found);
}

void YamlReader::seed(std::string_view key, std::uint64_t& value) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  std::uint64_t found = 0;
  if (!node.IsScalar() || node.Scalar().find('-') != std::string::npos ||
      !YAML::convert<std::uint64_t>::decode(node, found))
    return fault(key, fmt::format("is {}, expected a whole number from 0", kind_of(node)));
  value = found;
}

void YamlReader::flag(std::string_view key, bool& value) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value))
    fault(key, fmt::format("is {}, expected true or false", kind_of(node)));
}

void YamlReader::text(std::string_view key, std::string& value) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  if (!node.IsScalar() || node.Scalar().empty())
    return fault(key, fmt::format("is {}, expected text", kind_of(node)));
  value = node.Scalar();
}

void YamlReader::texts(std::string_view key, std::vector<std::string>& values) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  if (node.IsScalar()) {
    values = {node.Scalar()};
    return;
  }
  if (!node.IsSequence())
    return fault(key, fmt::format("is {}, expected a list of texts", kind_of(node)));
  values = texts_of(key, node);
}

void YamlReader::lists(std::string_view key, std::vector<std::vector<std::string>>& values) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  if (!node.IsSequence())
    return fault(key, fmt::format("is {}, expected a list of lists of texts", kind_of(node)));
  values.clear();
  for (const YAML::Node& item : node) {
    if (item.IsSequence())
      values.push_back(texts_of(key, item));
    else
      faults_.add(item.Mark(), fmt::format("{}: holds {}, expected lists of texts", path_of(key),
                                           kind_of(item)));
  }
}

std::vector<std::string> YamlReader::texts_of(std::string_view key, const YAML::Node& list) {
  std::vector<std::string> values;
  for (const YAML::Node& item : list) {
    if (item.IsScalar())
      values.push_back(item.Scalar());
    else
      faults_.add(item.Mark(),
                  fmt::format("{}: holds {}, expected texts", path_of(key), kind_of(item)));
  }
  return values;
}

void YamlReader::choice(std::string_view key, std::span<const std::string_view> choices,
                        int& value) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  const auto found =
      node.IsScalar() ? std::find(choices.begin(), choices.end(), node.Scalar()) : choices.end();
  if (found == choices.end())
    return fault(key,
                 fmt::format("is {}, expected one of {}", kind_of(node), fmt::join(choices, ", ")));
  value = static_cast<int>(found - choices.begin());
}

bool YamlReader::numbers(std::string_view key, std::vector<double>& values, std::size_t n) {
  if (!has(key)) return false;
  if (to_numbers(take(key), n, values)) return true;
  fault(key, fmt::format("is {}, expected a list of {} numbers", kind_of(take(key)), n));
  return false;
}

void YamlReader::point(std::string_view key, Vec2& value) {
  std::vector<double> v;
  if (numbers(key, v, 2)) value = {v[0], v[1]};
}

void YamlReader::point(std::string_view key, Vec3& value) {
  std::vector<double> v;
  if (numbers(key, v, 3)) value = {v[0], v[1], v[2]};
}

void YamlReader::points(std::string_view key, std::vector<Vec2>& values) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  if (!node.IsSequence())
    return fault(key, fmt::format("is {}, expected a list of [x, y]", kind_of(node)));
  values.clear();
  std::vector<double> v;
  for (const YAML::Node& item : node) {
    if (to_numbers(item, 2, v))
      values.emplace_back(v[0], v[1]);
    else
      faults_.add(item.Mark(),
                  fmt::format("{}: a point is {}, expected [x, y]", path_of(key), kind_of(item)));
  }
}

void YamlReader::section(std::string_view key, const std::function<void(YamlReader&)>& read) {
  if (!has(key)) return;
  YamlReader inner(take(key), path_of(key), faults_);
  read(inner);
  inner.finish();
}

void YamlReader::list(std::string_view key, const std::function<void(YamlReader&)>& read) {
  if (!has(key)) return;
  const YAML::Node node = take(key);
  if (!node.IsSequence()) return fault(key, fmt::format("is {}, expected a list", kind_of(node)));
  for (std::size_t i = 0; i < node.size(); ++i) {
    YamlReader item(node[i], fmt::format("{}[{}]", path_of(key), i), faults_);
    read(item);
    item.finish();
  }
}

void YamlReader::finish() {
  if (!node_.IsMap()) return;
  std::sort(asked_.begin(), asked_.end());
  asked_.erase(std::unique(asked_.begin(), asked_.end()), asked_.end());
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (!std::binary_search(asked_.begin(), asked_.end(), key))
      faults_.add(entry.first.Mark(), fmt::format("{}: unknown key; known are {}", path_of(key),
                                                  fmt::join(asked_, ", ")));
  }
}

}  // namespace foretrack
