// SPDX-License-Identifier: Apache-2.0
// What the vehicle sees: as large as wanted, with everybody in it, who can be tapped to be followed.
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

import { saveClip } from "../ui/clip.ts";
import { download } from "../ui/download.ts";
import { age, timeOfDay } from "../ui/format.ts";
import { Icon } from "../ui/icon.tsx";
import type { Layout } from "../ui/layout.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { People, TapMenu, type Tapped } from "./people.tsx";
import { PictureScreen, pictureAge_s } from "./screen.ts";

const old_s = 1;

/** Why there is no picture; "": there is, or will be. */
export function whyNone(session: Session): string {
  const { replay, vehicle, pictures } = session;
  if (!vehicle) return t("no vehicle");
  const { latest } = vehicle;
  if (latest["camera/ground/image/compressed"] || latest["camera/ground/video"]) return "";
  if (replay)
    return session.hasVideo || replay.recording.topics().includes(session.picture) ? ""
      : t("This recording has no pictures.");
  if (pictures.offers(session.picture) || session.hasVideo) return t("Waiting for the first picture …");
  const color = `${vehicle.name}/camera/color/image`;
  const hasCamera = session.liveState.station?.message.topics.some((topic) =>
    topic.topic.includes(color) && topic.writers > 0) ?? false;
  return hasCamera
    ? t("The vehicle has a camera and sends no pictures: perception is not running, or " +
      "ground_stream is switched off.")
    : t("No colour images come from the vehicle, so there is nothing to show.");
}

async function snapshot(session: Session, screen: PictureScreen | null): Promise<void> {
  const vehicle = session.vehicle?.name ?? "";
  const time = timeOfDay(session.now_s, 1);
  const blob = await screen?.snapshot(`${vehicle}  ${time} UTC`);
  if (blob) download(blob, `${vehicle}_${time.replace(/[:.]/g, "")}.png`);
  else session.notice(t("There is no picture to keep."), true);
}

function useFull(section: { current: HTMLElement | null }): [boolean, () => void] {
  const [full, setFull] = useState(false);
  useEffect(() => {
    const listen = (): void => {
      if (!document.fullscreenElement) setFull(false);
    };
    document.addEventListener("fullscreenchange", listen);
    return () => document.removeEventListener("fullscreenchange", listen);
  }, []);
  const toggle = (): void => {
    setFull(!full);
    if (full && document.fullscreenElement) void document.exitFullscreen();
    else if (!full) void section.current?.requestFullscreen?.().catch(() => {});
  };
  return [full, toggle];
}

interface Props { session: Session; layout: Layout; swap?(): void; hide?(): void }

export function PicturePanel({ session, layout, swap, hide }: Props) {
  const section = useRef<HTMLElement>(null);
  const host = useRef<HTMLDivElement>(null);
  const screen = useRef<PictureScreen | null>(null);
  const [tapped, setTapped] = useState<Tapped | null>(null);
  const [full, toggleFull] = useFull(section);
  useLayoutEffect(() => { // at once: the first picture may be there
    screen.current = new PictureScreen(session, host.current!);
    session.watching = true;
    return () => {
      session.watching = false;
      screen.current?.destroy();
    };
  }, []);
  const { vehicle } = session;
  const stamp_s = screen.current?.stamp_s ?? null;
  const age_s = vehicle && stamp_s !== null ? pictureAge_s(session.now_s, vehicle, stamp_s) : -1;
  const old = stamp_s !== null && age_s > old_s;
  const none = stamp_s === null ? whyNone(session) : "";
  const tap = (event: MouseEvent): void => {
    const rect = host.current!.getBoundingClientRect();
    const [x, y] = [event.clientX - rect.left, event.clientY - rect.top];
    const box = screen.current?.at(x, y) ?? null;
    setTapped(box && { who: box, x, y });
  };
  const small = layout === "inset" && !full;
  return (
    <section class={`camview ${full ? "full" : ""} ${old ? "old" : ""} ${none ? "none" : ""}`}
      aria-label={t("picture")} ref={section}
      onKeyDown={(event) => {
        if (event.key !== "Escape") return;
        setTapped(null);
        if (full) toggleFull();
      }}>
      <div class="frame" ref={host} onClick={tap} />
      {none ? <p class="why">{none}</p> : null}
      {stamp_s !== null ? (
        <output class={`age ${old ? "bad" : ""}`} data-field="picture-age">
          {old ? `▲ ${t("{age} old", { age: age(age_s) })}` : `${(1e3 * age_s).toFixed(0)} ms`}
        </output>
      ) : null}
      {tapped ? (
        <TapMenu session={session} tapped={tapped} close={() => setTapped(null)} />
      ) : null}
      <nav class="tools" aria-label={t("picture")}>
        {swap ? (
          <button onClick={swap} title={small ? t("picture large") : t("picture small")}
            aria-label={small ? t("picture large") : t("picture small")}><Icon name={small ? "larger" : "smaller"} /></button>
        ) : null}
        <button onClick={toggleFull} aria-pressed={full} title={t("full screen")}
          aria-label={t("full screen")}><Icon name="full" /></button>
        {session.hasVideo && session.video.possible ? (
          <button aria-pressed={session.video.on} title={t("as video")} aria-label={t("as video")}
            onClick={() => {
              session.video.wanted = !session.video.on;
              session.changed();
            }}><Icon name="film" /></button>
        ) : null}
        <button onClick={() => void snapshot(session, screen.current)} title={t("snapshot")}
          aria-label={t("snapshot")}><Icon name="camera" /></button>
        <button onClick={() => void saveClip(session)} title={t("clip of the last 20 s")}
          aria-label={t("clip of the last 20 s")}><Icon name="clip" /></button>
        {hide ? (
          <button onClick={hide} title={t("hide the picture")}
            aria-label={t("hide the picture")}><Icon name="close" /></button>
        ) : null}
      </nav>
      {small ? null : <People session={session} boxes={screen.current?.people ?? []} />}
    </section>
  );
}
