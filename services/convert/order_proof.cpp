// SPDX-License-Identifier: Apache-2.0
#include "services/convert/order_proof.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <bit>
#include <memory>
#include <optional>
#include <stdexcept>

namespace foretrack {
namespace {

using Order = foretrack_msgs::msg::MissionCommand;
using Key = std::array<unsigned char, 32>;
using KeyPtr = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using ContextPtr = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

constexpr std::size_t kSignature = 64;

std::string hex_of(const Key& key) {
  std::string text;
  for (const unsigned char byte : key) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::optional<Key> key_of(std::string_view hex) {
  Key key{};
  if (hex.size() != 2 * key.size()) return std::nullopt;
  for (std::size_t i = 0; i < hex.size(); ++i) {
    const auto digit = std::string_view("0123456789abcdef").find(hex[i]);
    if (digit == std::string_view::npos) return std::nullopt;
    key[i / 2] = static_cast<unsigned char>(key[i / 2] << 4 | digit);
  }
  return key;
}

std::string bits_of(double value) {
  return fmt::format(" {:016x}", std::bit_cast<std::uint64_t>(value));
}

std::string signed_text(std::string_view vehicle, const Order& order) {
  const std::string_view name = order.operator_id().c_str();
  const auto& stamp = order.header().stamp();
  std::string text = fmt::format("foretrack order 3\n{}:{}\n{} {}\n{} {}\n{}:{}\n{}\n",
                                 vehicle.size(), vehicle, stamp.sec(), stamp.nanosec(), order.id(),
                                 order.command(), name.size(), name, order.lease_id().c_str());
  for (const double value : order.fence_m()) text += bits_of(value);
  const auto& framing = order.framing();
  return text + '\n' + bits_of(order.altitude_min_m()) + bits_of(order.altitude_max_m()) +
         fmt::format("\n{}\n", order.person_id()) + bits_of(framing.distance_m()) +
         bits_of(framing.height_m()) + bits_of(framing.bearing_rad()) +
         bits_of(framing.circling_radps()) + bits_of(order.return_place_m()[0]) +
         bits_of(order.return_place_m()[1]);
}

const unsigned char* bytes_of(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

LeaseKey::LeaseKey() {
  if (RAND_bytes(secret_.data(), static_cast<int>(secret_.size())) != 1)
    throw std::runtime_error("no random numbers");
  const KeyPtr key(
      EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, secret_.data(), secret_.size()),
      EVP_PKEY_free);
  Key open{};
  std::size_t size = open.size();
  if (!key || EVP_PKEY_get_raw_public_key(key.get(), open.data(), &size) != 1)
    throw std::runtime_error("OpenSSL makes no Ed25519 key");
  id_ = hex_of(open);
}

void LeaseKey::sign(std::string_view vehicle, Order& order) const {
  order.lease_id(id_);
  const std::string text = signed_text(vehicle, order);
  const KeyPtr key(
      EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, secret_.data(), secret_.size()),
      EVP_PKEY_free);
  const ContextPtr context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  std::size_t size = kSignature;
  if (EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key.get()) != 1 ||
      EVP_DigestSign(context.get(), order.proof().data(), &size, bytes_of(text), text.size()) != 1)
    throw std::runtime_error("OpenSSL signs no order");
}

bool is_proved(std::string_view vehicle, const Order& order) {
  const auto id = key_of(order.lease_id().c_str());
  if (!id) return false;
  const KeyPtr key(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, id->data(), id->size()),
                   EVP_PKEY_free);
  if (!key) return false;
  const std::string text = signed_text(vehicle, order);
  const ContextPtr context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  return EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
         EVP_DigestVerify(context.get(), order.proof().data(), kSignature, bytes_of(text),
                          text.size()) == 1;
}

}  // namespace foretrack
