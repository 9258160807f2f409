// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";

import { rank } from "../store/alarms.ts";
import { bytes, duration, timeOfDay } from "../ui/format.ts";
import { Icon } from "../ui/icon.tsx";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Badge } from "./badge.tsx";
import { Commands } from "./commands.tsx";

function Link({ session }: { session: Session }) {
  const { link, station, now_s } = session.liveState;
  if (!link.open)
    return <span data-field="station"><Badge mood="alarm">{t("no station:")} {link.reason}</Badge></span>;
  const clients = station?.message.server.clients;
  const quiet_s = station ? now_s - station.time_s : 0;
  if (quiet_s > 3)
    return (
      <span data-field="station">
        <Badge mood="warning">{t("station quiet for {seconds} s",
          { seconds: quiet_s.toFixed(0) })}</Badge></span>
    );
  return (
    <span data-field="station"><Badge mood="good">{session.replay ? t("station") : t("live")}</Badge>
      <small> {clients === undefined ? "" : t("{count} watching", { count: clients })}</small></span>
  );
}

function Alarms({ session }: { session: Session }) {
  const open = [...session.state.alarms.values()].filter((a) => !a.acknowledged);
  if (open.length === 0) return <span class="alarms none">{t("no alarms")}</span>;
  const worst = open.reduce((a, b) => (rank(b.severity) > rank(a.severity) ? b : a));
  const mood = worst.severity === "alarm" ? "alarm" : "warning";
  return (
    <button class="alarms" onClick={() => session.tell({ kind: "acknowledge", key: "all" })}
      title={t("acknowledge all (A)")}>
      <Badge mood={mood}>{open.length} · {worst.vehicle} {worst.text}</Badge>
    </button>
  );
}

function Record({ session }: { session: Session }) {
  const recording = session.liveState.station?.message.recording;
  if (!recording?.active) return null;
  return (
    <span class="recording" data-field="recording" title={recording.file}>
      <i aria-hidden>⬤</i> {duration(recording.seconds)} · {bytes(recording.bytes)}
    </span>
  );
}

function Mute({ session }: { session: Session }) {
  const { muted } = session.sound;
  const word = muted ? t("alarms are silent: let them sound (M)") : t("silence alarms (M)");
  return (
    <button class="quiet" aria-pressed={muted} aria-label={word} title={word}
      onClick={() => {
        session.sound.toggle();
        session.changed();
      }}><Icon name={muted ? "silent" : "sound"} /></button>
  );
}

interface Props { session: Session; stop: ComponentChildren; help(): void }

export function TopBar({ session, stop, help }: Props) {
  return (
    <header class="bar">
      <h1>foretrack</h1>
      <Link session={session} />
      <time title={t("UTC, of what is shown")}>{timeOfDay(session.state.now_s)}</time>
      <Record session={session} />
      <Alarms session={session} />
      <span class="spring" />
      {stop ? <Commands session={session} /> : null}
      <Mute session={session} />
      <button class="quiet" data-for="keys" onClick={help} aria-label={t("keys")}>?</button>
      {stop}
    </header>
  );
}
