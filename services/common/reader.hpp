// SPDX-License-Identifier: Apache-2.0
// A typed reader of one topic: newest wins, bad samples are counted and never seen.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "services/common/endpoint.hpp"
#include "services/common/node.hpp"

namespace foretrack {

/// Why a sample is not acceptable; null: it is. The texts are constants, as they are counted.
template <class T>
using Validation = std::function<const char*(const T&)>;

/// Include the message's generated header where this is used.
///
/// A sample is refused, and counted by reason, if its bytes are malformed, if its header's stamp is
/// malformed or in the future, if `also` says so, or if it does not convert. A conversion is a
/// callable on the sample (`from_idl`) that returns what has `operator bool`, `operator*` and
/// `fault()`, which has a `field` to count by and a `text`; the first of a field is reported. It
/// may move from the sample, so that big ones are not copied.
template <class Topic>
class Reader {
 public:
  using Type = typename Topic::Type;
  template <class Convert>
  using Value = std::decay_t<decltype(*std::declval<std::invoke_result_t<Convert&, Type>&>())>;

  explicit Reader(Node& node, Validation<Type> also = nullptr)
      : node_(&node),
        core_(&node.add_reader(Topic::info, type_ops<Type>())),
        also_(std::move(also)) {}

  /// Takes all that came and returns the newest good one; null if there is none. It stays valid
  /// until the next take.
  const Type* take_newest() {
    bool found = false;
    take_each([&](Type& sample) {
      std::swap(newest_, sample);
      found = true;
    });
    return found ? &newest_ : nullptr;
  }

  /// The same, converted.
  template <class Convert>
  std::optional<Value<Convert>> take_newest_as(Convert&& convert) {
    std::optional<Value<Convert>> newest;
    take_each_as(convert, [&](auto&& value) { newest = std::move(value); });
    return newest;
  }

  /// Every good sample that came, oldest first.
  template <class Callback>
  void take_each(Callback&& callback) {
    while (core_->take(&taken_)) {
      if (!is_good()) continue;
      core_->stats.accept();
      callback(taken_);
    }
  }

  template <class Convert, class Callback>
  void take_each_as(Convert&& convert, Callback&& callback) {
    while (core_->take(&taken_)) {
      if (!is_good()) continue;
      auto converted = convert(std::move(taken_));
      if (!converted) {
        refuse(converted.fault());
        continue;
      }
      core_->stats.accept();
      callback(std::move(*converted));
    }
  }

  /// Seconds since the last good sample; −1: none yet.
  double age_s() const { return core_->stats.age_s(); }
  /// For what only the service can judge. Counted by reason.
  void reject(std::string_view reason) { core_->stats.reject(reason); }
  /// The same, with the text of the first of each field reported.
  template <class Fault>
  void refuse(const Fault& fault) {
    core_->stats.reject(fault.field);
    if (core_->stats.rejected_for(fault.field) == 1)
      node_->report(core_->stats.topic + ": " + std::string(fault.text));
  }
  int writers() const { return core_->stats.peers; }
  /// From now on samples stamped ahead of our clock are taken, too: the service judges them.
  void take_future_stamps() { takes_future_stamps_ = true; }
  /// See ReaderCore.
  void pin_writer(double silence_s) { core_->pin_writer(silence_s); }
  void notice_second_writers(double silence_s) { core_->notice_second_writers(silence_s); }
  const EndpointStats& stats() const { return core_->stats; }
  ReaderCore& core() { return *core_; }

 private:
  bool is_good() {
    const char* why = nullptr;
    if constexpr (requires { taken_.header().stamp(); })
      if (!takes_future_stamps_) why = node_->clock().fault_of(taken_.header().stamp());
    if (!why && also_) why = also_(taken_);
    if (why) core_->stats.reject(why);
    return !why;
  }

  Node* node_;
  ReaderCore* core_;
  Validation<Type> also_;
  bool takes_future_stamps_ = false;
  Type newest_;
  Type taken_;
};

}  // namespace foretrack
