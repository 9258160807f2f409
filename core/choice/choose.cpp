// SPDX-License-Identifier: Apache-2.0
#include "core/choice/choose.hpp"

#include <algorithm>
#include <cmath>

#include "core/choice/meets.hpp"

namespace foretrack {
namespace {

constexpr double kLikenessScale = 0.2;
constexpr double kRestart_s = 1.0;   // time that goes back: a simulation was started anew
constexpr double kStepsShare = 0.2;  // of a look, in the mean over the looks since they parted
constexpr double kLately_s = 1.0;    // somebody who was not seen for longer is not there

/// Everybody around, with what images show of them.
struct Others {
  const ChoiceInput& in;
  const PersonLook* look(int i) const {
    const bool has = static_cast<std::size_t>(i) < in.looks.size();
    return has && in.looks[static_cast<std::size_t>(i)].known() ? &in.looks[i] : nullptr;
  }
  const MovingBody& body(int i) const { return in.bodies.bodies[i]; }
  bool is_person(int i) const { return body(i).kind == BodyKind::kPerson && !body(i).followed; }
};

ChoiceCandidate candidate_of(const MovingBody& body, double difference) {
  ChoiceCandidate c{body.id, likeness_of(difference), body.position_enu_m, difference};
  c.torso_enu_m.z() += kTorsoShare * body.height_m;
  return c;
}

void add(ChoiceResult& out, const ChoiceCandidate& candidate) {
  int at = out.count;
  while (at > 0 && out.candidates[at - 1].likeness < candidate.likeness) --at;
  if (at == ChoiceResult::kMostCandidates) return;
  out.count = std::min(out.count + 1, ChoiceResult::kMostCandidates);
  for (int k = out.count - 1; k > at; --k) out.candidates[k] = out.candidates[k - 1];
  out.candidates[at] = candidate;
}

template <std::size_t kSize>
bool is_among(const std::array<std::uint32_t, kSize>& ids, int count, std::uint32_t id) {
  return std::find(ids.begin(), ids.begin() + count, id) != ids.begin() + count;
}

void meet(ChoiceState& s, std::uint32_t id) {
  if (!is_among(s.met, s.met_count, id) && s.met_count < ChoiceState::kMostMet)
    s.met[s.met_count++] = id;
}

void forget_meeting(ChoiceState& s) {
  s.met_count = s.doubtful_looks = 0;
  s.asked_s = -1.0;
  s.seen.reset();
}

// What is seen of who is followed now, averaged.
void look_at_followed(ChoiceState& s, const PersonLook* look) {
  if (!look || !look->wears || look->stamp_s == s.seen_s) return;
  s.seen_s = look->stamp_s;
  if (s.seen)
    learn(*s.seen, *look->wears, kStepsShare);
  else
    s.seen = look->wears;
}

void learn_clothes(ChoiceState& s, double dt_s, const ChoiceParams& p) {
  if (!s.seen) return;
  if (!s.wears)
    s.wears = s.seen;
  else
    learn(*s.wears, *s.seen, std::clamp(dt_s / p.learn_s, 0.0, 1.0));
}

void take_over(ChoiceState& s, std::uint32_t id, bool by_order, ChoiceResult& out) {
  out.take_over = id;
  out.by_order = by_order;
  out.status = id == 0 ? ChoiceStatus::kWaiting : ChoiceStatus::kFollowing;
  out.count = 0;
  forget_meeting(s);
  s.lost_s = -1.0;
  s.watched_count = 0;
}

// Waits for an answer; after that, as the parameters say.
void ask(ChoiceState& s, double now_s, std::uint32_t followed_id, const ChoiceParams& p,
         ChoiceResult& out) {
  if (s.asked_s < 0.0) s.asked_s = now_s;
  out.status = ChoiceStatus::kDoubtful;
  out.waits_s = std::max(p.wait_s - (now_s - s.asked_s), 0.0);
  if (out.count == 0 || out.waits_s > 0.0 || p.unanswered != 0) return;
  const std::uint32_t likeliest = out.candidates[0].person_id;
  if (likeliest != followed_id) return take_over(s, likeliest, false, out);
  forget_meeting(s);
  out.status = ChoiceStatus::kFollowing;
}

// Who is followed, and those of whom they met who may be them; the followed one's difference.
double list_candidates(const ChoiceState& s, const Others& others, const ChoiceParams& p,
                       const Appearance& own_wears, ChoiceResult& out) {
  const double own = lasting_difference(own_wears, *s.wears);
  add(out, candidate_of(others.body(0), own));
  for (int i = 1; i < others.in.bodies.count; ++i) {
    const PersonLook* look = others.look(i);
    if (!others.is_person(i) || !is_among(s.met, s.met_count, others.body(i).id) || !look ||
        !look->wears)
      continue;
    const double theirs = lasting_difference(*look->wears, *s.wears);
    if (theirs <= p.alike && theirs <= own + p.tell_apart)
      add(out, candidate_of(others.body(i), theirs));
  }
  return own;
}

// After they have parted: who of them is it?
void tell_apart(ChoiceState& s, const Others& others, const ChoiceParams& p, ChoiceResult& out) {
  const std::uint32_t followed_id = others.body(0).id;
  const double own = list_candidates(s, others, p, *s.seen, out);
  const ChoiceCandidate& best = out.candidates[0];
  if (best.person_id != followed_id && best.difference + p.tell_apart < own)
    return take_over(s, best.person_id, false, out);
  if (out.count > 1 || own > p.alike) return ask(s, others.in.now_s, followed_id, p, out);
  forget_meeting(s);
  out.count = 0;
}

// Whether somebody is with them now who may be taken for them. Who was never seen apart from them
// may have been them: the track may have gone on with the other one before anybody saw two.
bool notice_meetings(ChoiceState& s, const Others& others, const ChoiceParams& p) {
  bool together = false, comes_from_nowhere = false;
  auto apart = s.apart;  // now or before, of who is still there
  int apart_count = 0;
  for (int i = 1; i < others.in.bodies.count; ++i) {
    if (!others.is_person(i)) continue;
    const std::uint32_t id = others.body(i).id;
    const bool was_apart = is_among(s.apart, s.apart_count, id);
    const bool is_with_them =
        meets(others.body(0), others.body(i), others.in.vehicle_enu_m, p.meet_m);
    if (was_apart || !is_with_them) apart[apart_count++] = id;
    if (!is_with_them) continue;
    meet(s, id);
    together = true;
    comes_from_nowhere |= !was_apart;
  }
  s.apart = apart;
  s.apart_count = apart_count;
  if (!together) return false;
  if (others.in.doubtful) ++s.doubtful_looks;
  if (comes_from_nowhere) s.doubtful_looks = std::max(s.doubtful_looks, p.doubtful_looks);
  s.parted_s = others.in.now_s;
  s.seen.reset();
  return true;
}

// Somebody was found again: is it them?
void notice_return(ChoiceState& s, double now_s, const ChoiceParams& p) {
  if (s.lost_s < 0.0) return;
  s.lost_s = s.asked_s = -1.0;
  s.watched_count = 0;
  s.seen.reset();
  s.parted_s = now_s;
  s.doubtful_looks = p.doubtful_looks;
}

void follow(ChoiceState& s, const Others& others, double dt_s, const ChoiceParams& p,
            ChoiceResult& out) {
  const double now_s = others.in.now_s;
  const PersonLook* look = others.look(0);
  out.status = ChoiceStatus::kFollowing;
  out.person_id = s.followed_id = others.body(0).id;
  s.known = true;
  notice_return(s, now_s, p);
  const bool together = notice_meetings(s, others, p);
  if (!together) look_at_followed(s, look);
  if (look && look->wears && s.wears)
    out.likeness = likeness_of(lasting_difference(*look->wears, *s.wears));
  const bool settled = !together && now_s - s.parted_s > p.settle_s;
  const bool doubted = s.wears && s.doubtful_looks >= p.doubtful_looks;
  if (settled && s.seen && doubted) return tell_apart(s, others, p, out);
  if (s.asked_s >= 0.0 && look && look->wears) {
    list_candidates(s, others, p, *look->wears, out);
    return ask(s, now_s, others.body(0).id, p, out);
  }
  if (!settled || doubted) return;
  if (s.met_count > 0 || s.doubtful_looks > 0) forget_meeting(s);
  learn_clothes(s, dt_s, p);
}

// Who is around for long enough to be compared. Tracks that are gone are forgotten.
bool is_watched_long(ChoiceState& s, std::uint32_t id, double now_s, const ChoiceParams& p) {
  for (int k = 0; k < s.watched_count; ++k)
    if (s.watched[k].id == id) return now_s - s.watched[k].since_s >= p.candidate_s;
  if (s.watched_count < ChoiceState::kMostWatched) s.watched[s.watched_count++] = {id, now_s};
  return p.candidate_s <= 0.0;
}

void forget_who_went(ChoiceState& s, const MovingBodies& bodies) {
  const auto end = std::remove_if(
      s.watched.begin(), s.watched.begin() + s.watched_count, [&](const ChoiceState::Watched& w) {
        return std::ranges::find(bodies.all(), w.id, &MovingBody::id) == bodies.all().end();
      });
  s.watched_count = static_cast<int>(end - s.watched.begin());
}

void search(ChoiceState& s, const Others& others, const ChoiceParams& p, ChoiceResult& out) {
  const ChoiceInput& in = others.in;
  if (s.lost_s < 0.0) {
    s.lost_s = in.now_s;
    s.asked_s = -1.0;
    s.met_count = s.doubtful_looks = 0;
  }
  forget_who_went(s, in.bodies);
  out.status = in.now_s - s.lost_s < p.search_s ? ChoiceStatus::kSearching : ChoiceStatus::kLost;
  out.person_id = s.followed_id;
  out.likeness = 0.0;
  if (!s.wears) return;
  for (int i = 0; i < in.bodies.count; ++i) {
    const PersonLook* look = others.look(i);
    if (!others.is_person(i) || !look || !look->wears || in.now_s - look->stamp_s > kLately_s)
      continue;
    const double theirs = lasting_difference(*look->wears, *s.wears);
    if (!is_watched_long(s, others.body(i).id, in.now_s, p) || theirs > p.alike) continue;
    add(out, candidate_of(others.body(i), theirs));
  }
  if (out.count == 0) {
    s.asked_s = -1.0;
    return;
  }
  const bool alone =
      out.count == 1 || out.candidates[0].difference + p.tell_apart < out.candidates[1].difference;
  if (alone && s.asked_s < 0.0) return take_over(s, out.candidates[0].person_id, false, out);
  ask(s, in.now_s, 0, p, out);
}

void take_order(ChoiceState& s, const ChoiceInput& in, ChoiceResult& out) {
  const std::uint32_t id = *in.order;
  if (id == 0) {
    s = {};
    s.nobody = s.ordered = true;
    return take_over(s, 0, true, out);
  }
  const auto all = in.bodies.all();
  const auto it = std::ranges::find(all, id, &MovingBody::id);
  if (it == all.end()) return;  // gone meanwhile
  const std::size_t i = static_cast<std::size_t>(it - all.begin());
  const std::optional<Appearance> wears = i < in.looks.size() ? in.looks[i].wears : std::nullopt;
  const bool followed = it->followed;
  if (followed && s.seen) s.wears = s.seen;
  if (!followed) {
    s = {};
    s.wears = wears;
  }
  s.nobody = false;
  s.ordered = true;
  forget_meeting(s);
  if (!followed) take_over(s, id, true, out);
}

}  // namespace

double likeness_of(double difference) {
  const double scaled = difference / kLikenessScale;
  return std::exp(-0.5 * scaled * scaled);
}

ChoiceResult choose(ChoiceState& s, const ChoiceInput& in, const ChoiceParams& p) {
  if (in.now_s < s.now_s - kRestart_s) s = {};
  const double dt_s = s.now_s < 0.0 ? 0.0 : std::max(in.now_s - s.now_s, 0.0);
  s.now_s = in.now_s;
  ChoiceResult out;
  if (in.order) {
    take_order(s, in, out);
    s.now_s = in.now_s;
  }
  if (out.take_over) {
    out.person_id = *out.take_over;
    s.known = *out.take_over != 0;
    s.followed_id = *out.take_over;
    return out;
  }
  if (s.nobody) return out;
  const Others others{in};
  const bool seen = in.bodies.count > 0 && in.bodies.bodies[0].followed;
  if (seen)
    follow(s, others, dt_s, p, out);
  else if (s.known)
    search(s, others, p, out);
  return out;
}

}  // namespace foretrack
