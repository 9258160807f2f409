// SPDX-License-Identifier: Apache-2.0
// Every topic on the bus (or in the recording): rate, age, size, who writes, what does not match.
import { useState } from "preact/hooks";

import { partsOf } from "../data/topics.ts";
import type { State, Traffic } from "../store/state.ts";
import { age, bytes, number } from "../ui/format.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Badge } from "./badge.tsx";

interface Row {
  topic: string;
  type: string;
  rate_hz: number;
  age_s: number;
  size: number | null;
  bytes_s: number;
  writers: number | null;
  readers: number | null;
  resting: boolean; // nobody reads it, so its figures are the last known
  problems: string[];
}

function measured(state: State, t: Traffic): Row {
  return { topic: t.topic, type: t.type, rate_hz: t.rate_hz, age_s: state.now_s - t.heard_s,
    size: t.bytes, bytes_s: t.bytes_s, writers: null, readers: null,
    resting: false, problems: [] };
}

const strip = (topic: string): string => topic.replace(/^\//, "").replace(/^rt\//, "");

/** What the station says of each topic, and beside it what reached this page. */
export function topicRows(state: State, withStation: boolean): Row[] {
  const rows = new Map<string, Row>();
  for (const t of state.traffic.values()) rows.set(strip(t.topic), measured(state, t));
  const reported = withStation ? state.station?.message.topics ?? [] : [];
  for (const t of reported) {
    const here = rows.get(strip(t.topic));
    const problems: string[] = [];
    if (t.qos_mismatch) problems.push("QoS mismatch");
    if (t.foreign_type) problems.push(`foreign type ${t.foreign_type}`);
    if (t.limited) problems.push("limited");
    rows.set(strip(t.topic), { topic: t.topic, type: t.type, rate_hz: t.rate_hz,
      age_s: t.age_s ?? -1, bytes_s: t.bytes_s,
      size: t.rate_hz > 0 ? t.bytes_s / t.rate_hz : here?.size ?? null,
      writers: t.writers, readers: t.readers, resting: t.resting ?? false, problems });
  }
  return [...rows.values()].sort((a, b) =>
    b.problems.length - a.problems.length || strip(a.topic).localeCompare(strip(b.topic)));
}

function TopicRow({ row }: { row: Row }) {
  const silent = !row.resting && (row.age_s < 0 || row.age_s > 3);
  return (
    <tr data-topic={strip(row.topic)} class={silent ? "stale" : ""}>
      <td>{strip(row.topic)}</td>
      <td class="type">{row.type.replace(/^.*[/:]([^/:]+?)_?$/, "$1")}</td>
      <td class="n" data-of={t("rate")} data-field="rate">{number(row.rate_hz, 1, "Hz")}</td>
      <td class="n" data-of={t("age")} data-field="age">{row.resting ? t("resting") : age(row.age_s)}</td>
      <td class="n" data-of={t("size")}>{row.size === null ? "–" : bytes(row.size)}</td>
      <td class="n" data-of={t("flow")}>{bytes(row.bytes_s)}/s</td>
      <td class="n" data-of={t("writers")} data-field="writers">{row.writers ?? "–"}</td>
      <td class="n" data-of={t("readers")}>
        {row.readers === null || row.readers < 0 ? "–" : row.readers}</td>
      <td>{row.problems.map((p) => <Badge key={p} mood="warning">{p}</Badge>)}</td>
    </tr>
  );
}

export function TopicsPanel({ session }: { session: Session }) {
  const [filter, setFilter] = useState("");
  const [mine, setMine] = useState(false);
  const chosen = session.vehicle?.name;
  const rows = topicRows(session.state, !session.replay).filter((row) =>
    row.topic.includes(filter) && (!mine || partsOf(row.topic).vehicle === chosen));
  return (
    <div>
      <div class="row">
        <input placeholder={t("filter")} aria-label={t("filter")} value={filter}
          onInput={(event) => setFilter(event.currentTarget.value)} />
        <label><input type="checkbox" checked={mine}
          onChange={(event) => setMine(event.currentTarget.checked)} />
          {" "}{t("only {vehicle}", { vehicle: chosen ?? "–" })}</label>
      </div>
      <table class="fold" aria-label="topics">
        <thead><tr><th>{t("topic")}</th><th>{t("type")}</th><th>{t("rate")}</th><th>{t("age")}</th><th>{t("size")}</th><th>{t("flow")}</th>
          <th>{t("writers")}</th><th>{t("readers")}</th><th>{t("problems")}</th></tr></thead>
        <tbody>{rows.map((row) => <TopicRow key={row.topic} row={row} />)}</tbody>
      </table>
    </div>
  );
}
