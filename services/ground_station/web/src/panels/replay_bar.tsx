// SPDX-License-Identifier: Apache-2.0
// Play, pause, step, speed, scrub, go to a time, bookmarks: by the recording's log time.
import type { RefObject } from "preact";
import { useState } from "preact/hooks";

import { parseTime } from "../data/clock.ts";
import type { Replay } from "../data/replay.ts";
import { type Bookmark, loadBookmarks, saveBookmarks } from "../ui/bookmarks.ts";
import { duration, timeOfDay } from "../ui/format.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";

const speeds = [0.1, 0.25, 0.5, 1, 2, 5, 10];

interface Props { session: Session; mark: RefObject<() => void> }

function GoTo({ replay }: { replay: Replay }) {
  const [bad, setBad] = useState(false);
  return (
    <form onSubmit={(event) => {
      event.preventDefault();
      const text = new FormData(event.currentTarget).get("time");
      const time_s = parseTime(typeof text === "string" ? text : "", replay.clock);
      setBad(time_s === null);
      if (time_s === null) return;
      replay.seek(time_s);
      event.currentTarget.querySelector("input")?.blur(); // the keys are the replay's again
    }}>
      <input name="time" class={bad ? "bad" : ""} size={9} placeholder={t("go to 1:05")}
        aria-label={t("go to")} title={t("seconds or m:ss from the start, or hh:mm:ss UTC")} />
    </form>
  );
}

function Scrub({ replay, marks }: { replay: Replay; marks: Bookmark[] }) {
  const { begin_s, end_s } = replay.clock;
  const share = (time_s: number): string =>
    `${(100 * (time_s - begin_s)) / (end_s - begin_s || 1)}%`;
  return (
    <div class="scrub">
      <input type="range" aria-label={t("time")} min={0} max={end_s - begin_s} step={0.01}
        value={replay.time_s() - begin_s}
        onInput={(event) => replay.seek(begin_s + Number(event.currentTarget.value))} />
      {marks.map((m) => (
        <i key={m.time_s} class="mark" style={{ left: share(m.time_s) }} title={m.name} />
      ))}
    </div>
  );
}

export function ReplayBar({ session, mark }: Props) {
  const replay = session.replay!;
  const [marks, setMarks] = useState(() => loadBookmarks(replay.recording.name));
  const keep = (next: Bookmark[]): void => {
    setMarks(next);
    saveBookmarks(replay.recording.name, next);
  };
  mark.current = () => {
    const time_s = replay.time_s();
    keep([...marks, { time_s, name: duration(time_s - replay.clock.begin_s) }]
      .sort((a, b) => a.time_s - b.time_s));
  };
  const { clock } = replay;
  return (
    <section class="replay" aria-label={t("replay")}>
      <span class="what" title={replay.recording.name}>{t("REPLAY")} {replay.recording.name}</span>
      <button onClick={() => replay.step(-0.1)} aria-label={t("step back")}>◀▏</button>
      <button onClick={() => replay.play(!clock.playing)} class="play"
        aria-label={clock.playing ? t("pause") : t("play")}>{clock.playing ? "❚❚" : "▶"}</button>
      <button onClick={() => replay.step(0.1)} aria-label={t("step")}>▕▶</button>
      <select aria-label={t("speed")} value={clock.speed}
        onChange={(event) => replay.setSpeed(Number(event.currentTarget.value))}>
        {speeds.map((speed) => <option key={speed} value={speed}>{speed}×</option>)}
      </select>
      <Scrub replay={replay} marks={marks} />
      <time data-field="replay-time">{duration(replay.time_s() - clock.begin_s)} / {
        duration(clock.end_s - clock.begin_s)}</time>
      <time>{timeOfDay(replay.time_s(), 1)}</time>
      <GoTo replay={replay} />
      <button onClick={() => mark.current()} title={t("bookmark (B)")}>{t("Bookmark")}</button>
      {marks.map((m) => (
        <span key={m.time_s} class="bookmark">
          <button onClick={() => replay.seek(m.time_s)}>{m.name}</button>
          <button aria-label={`remove ${m.name}`}
            onClick={() => keep(marks.filter((x) => x !== m))}>×</button>
        </span>
      ))}
      {replay.isLoading() ? <em>{t("reading …")}</em> : null}
      {replay.problem ? <em class="bad">{replay.problem}</em> : null}
      <button class="end" onClick={() => session.endReplay()}>{t("End replay")}</button>
    </section>
  );
}
