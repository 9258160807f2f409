// SPDX-License-Identifier: Apache-2.0
// Services of the chosen vehicle, and every diagnostic status that comes.
import { levelWord, serviceWord, ServiceState } from "../data/words.ts";
import { age_s, type State } from "../store/state.ts";
import { silent_s } from "../store/watch.ts";
import { age, bytes, number } from "../ui/format.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Badge, type Mood } from "./badge.tsx";

function Services({ session }: { session: Session }) {
  const { state, vehicle } = session;
  const services = [...(vehicle?.services ?? [])].sort(([a], [b]) => a.localeCompare(b));
  return (
    <table class="fold" aria-label="services">
      <thead><tr><th>{t("service")}</th><th>{t("state")}</th><th>{t("processor")}</th><th>{t("memory")}</th><th>{t("work/loop")}</th>
        <th>{t("age")}</th><th>{t("last error")}</th></tr></thead>
      <tbody>{services.map(([name, heard]) => {
        const { message: h } = heard;
        const silent = age_s(state, heard) > silent_s;
        const mood: Mood = silent ? "alarm" : h.state === ServiceState.running ? "good" : "warning";
        return (
          <tr key={name} data-service={name} class={silent ? "stale" : ""}>
            <td>{name}</td>
            <td><Badge mood={mood}>{silent ? t("silent") : serviceWord(h.state)}</Badge></td>
            <td class="n" data-of={t("processor")}>{number(h.cpu_percent, 0, "%")}</td>
            <td class="n" data-of={t("memory")}>{bytes(Number(h.rss_bytes))}</td>
            <td class="n" data-of={t("work/loop")}>
              {number(h.loop_mean_ms, 1)} ({number(h.loop_max_ms, 0)}) ms</td>
            <td class="n" data-of={t("age")}>{age(age_s(state, heard))}</td>
            <td class="wrap">{h.last_error}</td>
          </tr>
        );
      })}</tbody>
    </table>
  );
}

const moods: Mood[] = ["good", "warning", "alarm", "quiet"];

function Statuses({ state }: { state: State }) {
  const rows = [...state.diagnostics.values()].sort((a, b) =>
    b.message.level - a.message.level || a.message.name.localeCompare(b.message.name));
  return (
    <table class="fold" aria-label="diagnostics">
      <thead><tr><th>{t("diagnostic")}</th><th>{t("level")}</th><th>{t("message")}</th><th>{t("values")}</th><th>{t("age")}</th></tr>
      </thead>
      <tbody>{rows.map((heard) => {
        const { name, level, message, values } = heard.message;
        return (
          <tr key={name} class={age_s(state, heard) > silent_s ? "stale" : ""}>
            <td>{name}</td>
            <td><Badge mood={moods[level] ?? "quiet"}>{levelWord(level)}</Badge></td>
            <td>{message}</td>
            <td class="wrap">{values.filter((v) => v.value).map((v) => `${v.key} ${v.value}`)
              .join(" · ")}</td>
            <td class="n" data-of={t("age")}>{age(age_s(state, heard))}</td>
          </tr>
        );
      })}</tbody>
    </table>
  );
}

export function DiagnosticsPanel({ session }: { session: Session }) {
  return <div><Services session={session} /><Statuses state={session.state} /></div>;
}
