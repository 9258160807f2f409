// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from "preact/hooks";

import { TapMenu, type Tapped } from "../picture/people.tsx";
import { useModule } from "../ui/hooks.ts";
import { spoken } from "../ui/palette.ts";
import type { Session } from "../ui/session.ts";
import { said, t } from "../ui/words.ts";
import type { ViewKind } from "./messages.ts";
import { SceneScreen } from "./screen.ts";

export interface SceneHandle { setView(kind: ViewKind): void; cut(): void }

const views: [ViewKind, string][] = [["follow", said("Follow")], ["orbit", said("Orbit")], ["top", said("Top")]];

export function ScenePanel({ session, handle }: { session: Session; handle: SceneHandle }) {
  const host = useRef<HTMLDivElement>(null);
  const screen = useRef<SceneScreen | null>(null);
  const [tapped, setTapped] = useState<Tapped | null>(null);
  const settled = useModule(() => session.settled);
  useEffect(() => {
    if (!settled) return;
    screen.current = new SceneScreen(session, host.current!);
    screen.current.onTap = setTapped;
    return () => screen.current?.destroy();
  }, [settled]);
  handle.setView = (kind) => {
    screen.current?.setView(kind);
    session.changed();
  };
  handle.cut = () => {
    screen.current?.toggleCut();
    session.changed();
  };
  const kind = screen.current?.kind ?? "follow";
  return (
    <section class="scene" aria-label={t("scene")}>
      <div class="canvas" ref={host} />
      <nav class="views" aria-label={t("view")}>
        {views.map(([name, word]) => (
          <button key={name} aria-pressed={kind === name} onClick={() => handle.setView(name)}>
            {t(word)}
          </button>
        ))}
        <button aria-pressed={screen.current?.cut ?? true} onClick={() => handle.cut()}
          title={t("cut walls low (W)")}>{t("Cut walls")}</button>
      </nav>
      {tapped ? (
        <TapMenu session={session} tapped={tapped} close={() => setTapped(null)} />
      ) : null}
      <Legend session={session} />
    </section>
  );
}

function Legend({ session }: { session: Session }) {
  const colors = session.vehicle?.intentionColors ?? new Map<string, string>();
  return (
    <ul class="legend" aria-label={t("legend")}>
      {[...colors].map(([name, color]) => (
        <li key={name}><i style={{ background: color }} />{spoken(name)}</li>
      ))}
      <li><i class="plan" />{t("plan")}</li>
      <li><i class="others" />{t("others")}</li>
    </ul>
  );
}
