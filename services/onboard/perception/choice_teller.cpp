// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/choice_teller.hpp"

#include <cmath>

#include "core/perception/cut_picture.hpp"
#include "services/convert/encode_jpeg.hpp"

namespace foretrack {
namespace {

constexpr double kPeriod_s = 0.2;
constexpr double kPicture_s = 2.0;  // the picture of who was chosen is taken anew so often
constexpr double kSameImage_s = 1e-6;
constexpr int kMost_px = 192;
constexpr int kQuality = 75;

}  // namespace

bool ChoiceTeller::is_news(const ChoiceResult& choice) const {
  const ChoiceResult& last = report_.choice;
  return choice.status != last.status || choice.person_id != last.person_id ||
         choice.count != last.count;
}

void ChoiceTeller::take_pictures(const ChoiceResult& choice, const MovingBodies& bodies,
                                 std::span<const PersonLook> looks, const RgbImage& image,
                                 double image_s) {
  for (int i = 0; i < bodies.count; ++i) {
    const PersonLook& look = looks[static_cast<std::size_t>(i)];
    const MovingBody& body = bodies.bodies[i];
    if (!look.known() || std::abs(look.stamp_s - image_s) > kSameImage_s) continue;
    const bool chosen = body.followed && choice.status == ChoiceStatus::kFollowing &&
                        std::abs(image_s - pictured_s_) > kPicture_s;
    const bool candidate =
        choice.status == ChoiceStatus::kDoubtful &&
        std::ranges::find(choice.all(), body.id, &ChoiceCandidate::person_id) != choice.all().end();
    if (!chosen && !candidate) continue;
    const RgbImage cut = cut_picture(image, look.box_low_px, look.box_high_px, kMost_px);
    if (cut.rgb.empty()) continue;
    encode_jpeg(cut, kQuality, chosen ? report_.picture : candidates_[body.id]);
    if (chosen) pictured_s_ = image_s;
  }
}

void ChoiceTeller::tell(double stamp_s, const ChoiceResult& choice, const MovingBodies& bodies,
                        std::span<const PersonLook> looks, const RgbImage* image, double image_s) {
  const double now_s = service_.clock().now_s();
  if (!is_news(choice) && std::abs(now_s - told_s_) < kPeriod_s) return;
  told_s_ = now_s;
  if (choice.person_id != report_.choice.person_id) {
    report_.picture.clear();
    pictured_s_ = -1e9;
  }
  if (choice.status != ChoiceStatus::kDoubtful) candidates_.clear();
  if (image) take_pictures(choice, bodies, looks, *image, image_s);
  report_.stamp_s = stamp_s;
  report_.choice = choice;
  for (int i = 0; i < choice.count; ++i)
    report_.pictures[i] = candidates_[choice.candidates[i].person_id];
  to_idl(report_, writer_.sample());
  writer_.write();
}

}  // namespace foretrack
