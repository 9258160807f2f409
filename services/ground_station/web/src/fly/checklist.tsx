// SPDX-License-Identifier: Apache-2.0
// What must be green before the vehicle takes off, and what it does when something fails.
import { obstacle } from "../panels/commands.tsx";
import { HoldButton } from "../panels/stop.tsx";
import { order } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { checklist, isReady, type Light, reactions } from "./checklist.ts";

const signs: Record<Light, string> = { green: "✓", red: "✗", note: "i" };

export function ChecklistPanel({ session }: { session: Session }) {
  const { state, liveState, vehicle } = session;
  if (!vehicle) return <p class="empty">{t("no vehicle")}</p>;
  const checks = checklist(state, liveState, vehicle);
  const ready = isReady(checks);
  const why = session.replay ? t("a recording is shown") : obstacle(session);
  const word = { green: t("good"), red: t("to be mended"), note: t("note") };
  return (
    <section class="checklist" aria-label={t("checklist")}>
      <h2>{t("Before take-off")}{" "}
        <span class={ready ? "ready" : "bad"} data-field="ready">
          {ready ? `✓ ${t("ready")}` : `✗ ${t("not ready")}`}</span></h2>
      <ul>{checks.map(({ light, what, todo }) => (
        <li key={what} class={light}><i aria-label={word[light]}>{signs[light]}</i>
          <span>{what}{todo ? <small> {todo}</small> : null}</span></li>
      ))}</ul>
      <div class="row takeoff">
        <HoldButton label={t("Take off")} hint={t("hold to confirm")} disabled={why !== "" || !ready}
          act={() => void order(session, session.commanded, "take_off")} calm />
        <HoldButton label={t("Land")} hint={t("hold to confirm")} disabled={why !== ""}
          act={() => void order(session, session.commanded, "land")} calm />
        {why ? <small>{why}</small> : null}
      </div>
      <h3>{t("If something fails")}</h3>
      <dl>{reactions(state, vehicle).map(([what, does]) => [<dt>{what}</dt>, <dd>{does}</dd>])}</dl>
    </section>
  );
}
