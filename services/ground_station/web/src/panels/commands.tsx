// SPDX-License-Identifier: Apache-2.0
// Orders to the chosen vehicle, under a lease that one operator holds.
import { lease, order } from "../ui/orders.ts";
import type { Command } from "../ui/operator.ts";
import type { Session } from "../ui/session.ts";
import { said, t } from "../ui/words.ts";

const commands: [Command, string][] = [
  ["take_off", said("Take off")], ["start", said("Start")], ["hold", said("Hold")], ["resume", said("Resume")],
  ["return", said("Return")], ["land", said("Land")],
];

/** Why the chosen vehicle cannot be commanded from here; "" if it can. */
export function obstacle(session: Session): string {
  const { link, station } = session.liveState;
  const { operator } = session;
  if (!link.open) return t("no connection to the station");
  if (!station) return t("the station has not reported yet");
  if (!session.commanded) return t("no vehicle");
  const { server, vehicles } = station.message;
  if (!server.control_enabled) return t("the station is read-only");
  if (server.needs_token && !operator.token) return t("a token is needed (Control)");
  if (!operator.name) return t("enter your name first");
  const holder = vehicles.find((v) => v.name === session.commanded)?.lease?.operator;
  if (!holder) return t("take control first");
  return holder === operator.name ? "" : t("{who} has control", { who: holder });
}

export function LeaseButton({ session }: { session: Session }) {
  const { operator, commanded, liveState } = session;
  const station = liveState.station?.message;
  const held = station?.vehicles.find((v) => v.name === commanded)?.lease;
  const mine = held !== null && held !== undefined && held.operator === operator.name;
  if (mine)
    return (
      <button class="lease mine" onClick={() => void lease(session, commanded, "release")}
        title={t("you have control; press to release it")}>{t("in control")}</button>
    );
  const cannot = !operator.name || !station?.server.control_enabled || !commanded;
  return (
    <button class="lease" disabled={cannot} title={held ? t("{who} has control", { who: held.operator }) : ""}
      onClick={() => void lease(session, commanded, "take")}>{t("Take control")}</button>
  );
}

export function NameField({ session }: { session: Session }) {
  const { operator } = session;
  return (
    <input class="operator" placeholder={t("your name")} maxLength={32} value={operator.typed}
      aria-label={t("operator")} autocomplete="off"
      onInput={(event) => {
        operator.name = event.currentTarget.value;
        session.changed();
      }} />
  );
}

export function Commands({ session }: { session: Session }) {
  const why = obstacle(session);
  return (
    <div class="commands" aria-label={t("commands")}>
      <NameField session={session} />
      <LeaseButton session={session} />
      <span class="orders">
        {commands.map(([command, word]) => (
          <button key={command} disabled={why !== ""} title={why}
            onClick={() => void order(session, session.commanded, command)}>{t(word)}</button>
        ))}
      </span>
      <output class={session.message.bad ? "bad" : ""} data-field="answer">
        {session.message.text || why}
      </output>
    </div>
  );
}
