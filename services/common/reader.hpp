// A typed reader of one topic: newest wins, bad samples are counted and never seen.
#pragma once

#include <functional>
#include <utility>

#include "services/common/endpoint.hpp"
#include "services/common/node.hpp"
#include "services/common/validate.hpp"

namespace foretrack {

/// Why a sample is not acceptable; null: it is. The texts are constants, as they are counted.
template <class T>
using Validation = std::function<const char*(const T&)>;

/// Include the message's generated header where this is used.
template <class Topic>
class Reader {
 public:
  using Type = typename Topic::Type;

  /// `also` is asked after validate(sample) of validate.hpp.
  explicit Reader(Node& node, Validation<Type> also = nullptr)
      : node_(&node),
        core_(&node.add_reader(Topic::info, type_ops<Type>())),
        also_(std::move(also)) {}

  /// Takes all that came and returns the newest valid one; null if there is none. It stays valid
  /// until the next take.
  const Type* take_newest() {
    bool found = false;
    while (take_valid()) found = true;
    return found ? &newest_ : nullptr;
  }

  /// Every valid sample that came, oldest first.
  template <class Callback>
  void take_each(Callback&& callback) {
    while (take_valid()) callback(std::as_const(newest_));
  }

  /// The last valid sample that was taken; null if there was none yet.
  const Type* newest() const { return core_->stats.samples > 0 ? &newest_ : nullptr; }
  /// Seconds since it came; −1: none yet.
  double age_s() const { return core_->stats.age_s(); }

  /// For what only the service can judge, e.g. a failed conversion. Counted by reason.
  void reject(std::string_view reason) { core_->stats.reject(reason); }

  int writers() const { return core_->stats.peers; }
  const EndpointStats& stats() const { return core_->stats; }
  ReaderCore& core() { return *core_; }

 private:
  bool take_valid() {
    while (core_->take(&taken_)) {
      if (const char* why = fault_of(taken_)) {
        core_->stats.reject(why);
        continue;
      }
      core_->stats.accept();
      std::swap(newest_, taken_);
      return true;
    }
    return false;
  }

  const char* fault_of(const Type& sample) const {
    if constexpr (requires { validate(sample); })
      if (const char* why = validate(sample)) return why;
    if constexpr (requires { sample.header().stamp(); })
      if (const char* why = validate_stamp(sample.header().stamp(), node_->clock().now_s()))
        return why;
    return also_ ? also_(sample) : nullptr;
  }

  Node* node_;
  ReaderCore* core_;
  Validation<Type> also_;
  Type newest_;
  Type taken_;
};

}  // namespace foretrack
