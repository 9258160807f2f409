// SPDX-License-Identifier: Apache-2.0
// Everybody in the picture as a list, for the keyboard and for those who do not see it.
import { obstacle } from "../panels/commands.tsx";
import { order } from "../ui/orders.ts";
import { Icon } from "../ui/icon.tsx";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import type { Box, Somebody } from "./overlay.ts";

/** Why nobody can be chosen now; "": they can. */
export function whyNotChoose(session: Session): string {
  if (session.replay) return t("a recording is shown: nobody can be chosen in it");
  return obstacle(session);
}

export function follow(session: Session, person_id: number): Promise<boolean> {
  return order(session, session.commanded, "follow", { person_id });
}

export interface Tapped { who: Somebody; x: number; y: number }

/** What can be done with whom was tapped; x and y are within what it lies on. */
export function TapMenu({ session, tapped, close }:
    { session: Session; tapped: Tapped; close(): void }) {
  const { who, x, y } = tapped;
  const far = who.distance_m === null ? "" : ` · ${who.distance_m.toFixed(1)} m`;
  const why = whyNotChoose(session) || (who.person ? "" : t("this is no person"));
  return (
    <div class="tapmenu" role="dialog" aria-label={t("person {id}", { id: who.id })}
      style={{ left: `clamp(4px, ${x}px - 90px, 100% - 190px)`,
        top: `clamp(4px, ${y}px + 8px, 100% - 110px)` }}
      onKeyDown={(event) => event.key === "Escape" && close()}>
      <b>{t("person {id}", { id: who.id })}{far}</b>
      <button class="follow" disabled={why !== ""} autofocus
        onClick={() => {
          void follow(session, who.followed ? 0 : who.id);
          close();
        }}>{who.followed ? t("Follow nobody") : t("Follow this person")}</button>
      {why ? <small>{why}</small> : null}
      <button class="quiet" aria-label={t("close")} onClick={close}><Icon name="close" /></button>
    </div>
  );
}

export function People({ session, boxes }: { session: Session; boxes: Box[] }) {
  const why = whyNotChoose(session);
  const people = boxes.filter((box) => box.person)
    .sort((a, b) => (a.distance_m ?? 99) - (b.distance_m ?? 99));
  if (people.length === 0) return null;
  return (
    <ul class="people" aria-label={t("people in the picture")}>
      {people.map((box) => (
        <li key={box.id}>
          <button disabled={why !== ""} aria-pressed={box.followed}
            title={why || (box.followed ? t("Follow nobody") : t("Follow this person"))}
            onClick={() => void follow(session, box.followed ? 0 : box.id)}>
            {box.followed ? "◉" : "○"} {box.id}
            {box.distance_m === null ? "" : ` · ${box.distance_m.toFixed(1)} m`}
          </button>
        </li>
      ))}
    </ul>
  );
}
