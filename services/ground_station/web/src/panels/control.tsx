// SPDX-License-Identifier: Apache-2.0
// Who has control of what, the last orders and their results, the token, and STOP for all.
import { lease, order } from "../ui/orders.ts";
import { outcome, resultWord } from "../data/words.ts";
import type { StationVehicle } from "../data/station.ts";
import { bytes } from "../ui/format.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Commands } from "./commands.tsx";
import { HoldButton } from "./stop.tsx";

function Token({ session }: { session: Session }) {
  return (
    <label>{t("token")} <input type="password" aria-label="token" value={session.operator.token}
      onChange={(event) => {
        session.operator.setToken(event.currentTarget.value);
        session.changed();
      }} /></label>
  );
}

function HandOver({ session, vehicle }: { session: Session; vehicle: StationVehicle }) {
  if (vehicle.lease?.operator !== session.operator.name || !session.operator.name) return null;
  return (
    <form onSubmit={(event) => {
      event.preventDefault();
      const to = new FormData(event.currentTarget).get("to");
      if (typeof to === "string" && to) void lease(session, vehicle.name, "hand_over", to.trim());
    }}>
      <input name="to" placeholder={t("to whom")} aria-label={`hand over ${vehicle.name} to`} />
      <button>{t("Hand over")}</button>
    </form>
  );
}

function Row({ session, vehicle }: { session: Session; vehicle: StationVehicle }) {
  const { lease: held, last_command: last } = vehicle;
  const gate = session.liveState.vehicles.get(vehicle.name)?.latest["safety/state"]?.message;
  return (
    <tr>
      <td>{vehicle.name}</td>
      <td data-of={t("control")} data-field={`lease-${vehicle.name}`}>
        {held ? `${held.operator}, ${Math.max(0, held.expires_s).toFixed(0)} s` : t("free")}</td>
      <td data-of={t("last order")}>{last ? t("{order} by {who}", { order: last.command, who: last.operator }) : "–"}</td>
      <td data-of={t("station")} data-field={`result-${vehicle.name}`}>
        {last ? outcome(last.result, last.reason) : "–"}</td>
      <td data-of={t("safety gate")}>{gate && gate.command_id > 0n
        ? `${resultWord(gate.command_result)} (${gate.operator_id || "–"})` : "–"}</td>
      <td><HandOver session={session} vehicle={vehicle} /></td>
    </tr>
  );
}

function Clients({ session }: { session: Session }) {
  const clients = session.liveState.station?.message.clients ?? [];
  return (
    <table class="fold" aria-label="clients">
      <thead><tr><th>{t("watching")}</th><th>{t("topics")}</th><th>{t("flow")}</th><th>{t("waiting")}</th><th>{t("left out")}</th></tr>
      </thead>
      <tbody>{clients.map((c) => (
        <tr key={c.id}>
          <td>{c.address}</td><td class="n" data-of={t("topics")}>{c.subscriptions}</td>
          <td class="n" data-of={t("flow")}>{bytes(c.bytes_s)}/s</td>
          <td class="n" data-of={t("waiting")}>{bytes(c.waiting_bytes)}</td>
          <td class="n" data-of={t("left out")}>{c.dropped}</td>
        </tr>
      ))}</tbody>
    </table>
  );
}

export function ControlPanel({ session }: { session: Session }) {
  const vehicles = session.liveState.station?.message.vehicles ?? [];
  return (
    <div class="control">
      <div class="row">
        <Commands session={session} />
        <Token session={session} />
      </div>
      <table class="fold">
        <thead><tr><th>{t("vehicle")}</th><th>{t("control")}</th><th>{t("last order")}</th><th>{t("station")}</th>
          <th>{t("safety gate")}</th><th /></tr></thead>
        <tbody>{vehicles.map((v) => <Row key={v.name} session={session} vehicle={v} />)}</tbody>
      </table>
      <Clients session={session} />
      {vehicles.length > 1 ? (
        <HoldButton label={t("STOP all")}
          act={() => vehicles.forEach((v) => void order(session, v.name, "stop"))} />
      ) : null}
    </div>
  );
}
