// SPDX-License-Identifier: Apache-2.0
// The vehicles that the chosen one hears: how near, how far believed, and from where it sees the person.
import type { FleetDivision, FleetPeer } from "../data/messages.ts";
import { trustWord, Trust } from "../data/words.ts";
import { age_s } from "../store/state.ts";
import { stale_s } from "../store/watch.ts";
import { number } from "../ui/format.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Aged } from "./badge.tsx";

const silent_s = 1; // who was not heard for so long has no seat
const sectors = 12; // of a ring, the first one towards east

/** In a sentence. */
export function seatText({ is_alone, is_near, seat }: FleetDivision): string {
  if (is_alone) return t("follows alone");
  const ring = is_near ? t("near") : t("behind");
  if (seat < 0) return ring;
  return t("{ring}, seen from {degrees}°", { ring, degrees: ((seat % sectors) * 360) / sectors });
}

function isDoubtful(peer: FleetPeer): boolean {
  return peer.age_s > silent_s || peer.trust === Trust.liar || peer.trust === Trust.unaligned;
}

function peerText(peer: FleetPeer): string {
  const gap = number(peer.separation_m, 1, "m");
  if (peer.age_s > silent_s)
    return `${peer.vehicle} ${t("silent for {time}", { time: number(peer.age_s, 0, "s") })}`;
  return isDoubtful(peer) ? `${peer.vehicle} ${gap} (${trustWord(peer.trust)})` : `${peer.vehicle} ${gap}`;
}

export function FleetRow({ session }: { session: Session }) {
  const heard = session.vehicle?.latest["fleet/division"];
  if (!heard || heard.message.peers.length === 0) return null;
  const division = heard.message;
  return <>
    <dt>{t("fleet")}</dt>
    <dd><Aged age_s={age_s(session.state, heard)} limit_s={stale_s}>
      <span data-field="seat">{seatText(division)}</span>
      {division.peers.map((peer) => (
        <span key={peer.vehicle} class={isDoubtful(peer) ? "off" : ""} data-field={`peer-${peer.vehicle}`}>
          {" · "}{peerText(peer)}</span>
      ))}
      {!division.is_alone && <span data-field="union">{" · "}
        {t("{share} % seen by somebody", { share: Math.round(100 * division.union_visibility) })}</span>}
    </Aged></dd>
  </>;
}
