// SPDX-License-Identifier: Apache-2.0
// Everybody in the picture as a list, for the keyboard and for those who do not see it.
import { obstacle } from "../panels/commands.tsx";
import { order } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import type { Box } from "./overlay.ts";

/** Why nobody can be chosen now; "": they can. */
export function whyNotChoose(session: Session): string {
  if (session.replay) return t("a recording is shown: nobody can be chosen in it");
  return obstacle(session);
}

export function follow(session: Session, person_id: number): Promise<boolean> {
  return order(session, session.commanded, "follow", { person_id });
}

interface ButtonProps { session: Session; box: Box; done?(): void; focus?: boolean }

export function FollowButton({ session, box, done, focus }: ButtonProps) {
  const why = whyNotChoose(session) || (box.person ? "" : t("this is no person"));
  const label = box.followed ? t("Follow nobody") : t("Follow this person");
  return (
    <button class="follow" disabled={why !== ""} title={why} autofocus={focus}
      onClick={() => {
        void follow(session, box.followed ? 0 : box.id);
        done?.();
      }}>{label}</button>
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
