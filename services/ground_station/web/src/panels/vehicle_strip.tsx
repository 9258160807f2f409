// SPDX-License-Identifier: Apache-2.0
// One card a vehicle: mode, health, age of the link, battery, rates, losses, who has control.
import {
  batteryWord, modeWord, phaseWord, saysSeveralPeople, serviceWord, ServiceState,
} from "../data/words.ts";
import { severityOf } from "../store/fold_vehicle.ts";
import { age_s, type State, type Vehicle } from "../store/state.ts";
import { gone_s, silent_s, stale_s } from "../store/watch.ts";
import { age, number } from "../ui/format.ts";
import { colorOf } from "../ui/palette.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Aged, Badge, type Mood } from "./badge.tsx";

function modeOf(state: State, vehicle: Vehicle) {
  const safety = vehicle.latest["safety/state"];
  if (!safety) return <Badge mood="quiet">{t("no gate")}</Badge>;
  const severity = severityOf(safety.message);
  const mood: Mood = severity === "info" ? (safety.message.mode === 0 ? "good" : "info") : severity;
  return (
    <Aged age_s={age_s(state, safety)} limit_s={stale_s}>
      <Badge mood={mood}><span data-field="mode">{modeWord(safety.message.mode)}</span></Badge>
      <small data-field="phase"> {phaseWord(safety.message.phase)}</small>
      <small>{safety.message.armed ? "" : ` · ${t("not armed")}`}</small>
    </Aged>
  );
}

/** The worst of its services. */
export function healthOf(state: State, vehicle: Vehicle): { mood: Mood; text: string } {
  const bad: string[] = [];
  let [silent, doubtful] = [0, false];
  for (const [name, heard] of vehicle.services) {
    const isSilent = age_s(state, heard) > silent_s;
    if (!isSilent && heard.message.state === ServiceState.running) continue;
    const inDoubt = !isSilent && saysSeveralPeople(heard.message);
    doubtful ||= inDoubt;
    bad.push(inDoubt ? t("several people: which one?")
      : `${name} ${isSilent ? t("silent") : serviceWord(heard.message.state)}`);
    if (isSilent) silent++;
  }
  const count = vehicle.services.size;
  if (count === 0) return { mood: "quiet", text: t("no health") };
  if (bad.length === 0) return { mood: "good", text: t("{count} services well", { count }) };
  const mood = silent > 0 || doubtful ? "alarm" : "warning";
  if (silent > 2) return { mood, text: t("{silent} of {count} services silent", { silent, count }) };
  return { mood, text: bad.join(", ") };
}

export function losses(vehicle: Vehicle): { count: number; reasons: string } {
  let count = 0;
  const reasons: string[] = [];
  for (const { message } of vehicle.services.values())
    for (const topic of message.topics)
      for (const { reason, samples } of topic.rejected) {
        count += Number(samples);
        reasons.push(`${message.service}, ${topic.topic}: ${samples} × ${reason}`);
      }
  return { count, reasons: reasons.join("\n") };
}

function rate(state: State, vehicle: Vehicle, name: string): string {
  const traffic = state.traffic.get(`/${vehicle.name}/${name}`) ??
    [...state.traffic.values()].find((t) => t.vehicle === vehicle.name && t.name === name);
  return number(traffic?.rate_hz, 0);
}

function battery(state: State, vehicle: Vehicle) {
  const heard = vehicle.latest["fmu/out/battery_status"];
  if (!heard) return <span title="no battery_status came">–</span>;
  const { remaining, voltage_v, warning } = heard.message;
  const mood: Mood = warning > 1 ? "alarm" : warning > 0 ? "warning" : "good";
  return (
    <Aged age_s={age_s(state, heard)} limit_s={5}>
      <Badge mood={mood}>{number(100 * remaining, 0, "%")}</Badge>
      <small> {number(voltage_v, 1, "V")}{warning > 0 ? ` ${batteryWord(warning)}` : ""}</small>
    </Aged>
  );
}

function Card({ session, vehicle }: { session: Session; vehicle: Vehicle }) {
  const { state } = session;
  const health = healthOf(state, vehicle);
  const lost = losses(vehicle);
  const link_s = state.now_s - vehicle.heard_s;
  const unconfirmed = session.replay ? null
    : session.liveState.station?.message.vehicles.find((v) => v.name === vehicle.name)?.unconfirmed;
  const holder = session.replay ? vehicle.latest["safety/state"]?.message.lease_operator
    : session.liveState.station?.message.vehicles.find((v) => v.name === vehicle.name)?.lease
      ?.operator;
  const silent = link_s > gone_s;
  return (
    <button class={`card ${silent ? "silent" : ""}`} data-vehicle={vehicle.name}
      aria-pressed={session.vehicle === vehicle} onClick={() => session.choose(vehicle.name)}>
      <span class="name"><i style={{ background: colorOf(vehicle.index) }} />{vehicle.name}</span>
      {modeOf(state, vehicle)}
      <span data-field="health"><Badge mood={health.mood}>{health.text}</Badge></span>
      {unconfirmed ? (
        <span data-field="order"><Badge mood="alarm">{t("{order} not confirmed",
          { order: unconfirmed.command })}</Badge></span>
      ) : null}
      <dl>
        <div><dt>{t("link")}</dt>
          <dd data-field="link" class={link_s > stale_s ? "bad" : ""}>{age(link_s)}</dd></div>
        <div><dt>{t("battery")}</dt><dd data-field="battery">{battery(state, vehicle)}</dd></div>
        <div><dt title={t("samples a second: odometry, person, plan")}>{t("rates")}</dt>
          <dd data-field="rates">{rate(state, vehicle, "odometry")} · {
            rate(state, vehicle, "target/state")} · {rate(state, vehicle, "plan/trajectory")} Hz</dd>
        </div>
        <div><dt title={lost.reasons || t("samples that services refused")}>{t("losses")}</dt>
          <dd data-field="losses" title={lost.reasons}>{lost.count}</dd></div>
        <div><dt>{t("control")}</dt><dd data-field="lease">{holder || t("free")}</dd></div>
      </dl>
    </button>
  );
}

export function VehicleStrip({ session }: { session: Session }) {
  const { vehicles } = session;
  return (
    <section class="strip" aria-label={t("vehicles")}>
      {vehicles.map((v) => <Card key={v.name} session={session} vehicle={v} />)}
      {vehicles.length === 0 ? (
        <p class="empty">{session.liveState.link.open
          ? t("No vehicle is heard. Start one with: foretrack up")
          : t("Not connected to the station.")}</p>
      ) : null}
    </section>
  );
}
