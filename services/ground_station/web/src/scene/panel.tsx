// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from "preact/hooks";

import { TapMenu, type Tapped } from "../picture/people.tsx";
import { spoken } from "../ui/palette.ts";
import type { Session } from "../ui/session.ts";
import type { ViewKind } from "./messages.ts";
import { SceneScreen } from "./screen.ts";

export interface SceneHandle { setView(kind: ViewKind): void; cut(): void }

const views: [ViewKind, string][] = [["follow", "Follow"], ["orbit", "Orbit"], ["top", "Top"]];

export function ScenePanel({ session, handle }: { session: Session; handle: SceneHandle }) {
  const host = useRef<HTMLDivElement>(null);
  const screen = useRef<SceneScreen | null>(null);
  const [tapped, setTapped] = useState<Tapped | null>(null);
  useEffect(() => {
    screen.current = new SceneScreen(session, host.current!);
    screen.current.onTap = setTapped;
    return () => screen.current?.destroy();
  }, []);
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
    <section class="scene" aria-label="scene">
      <div class="canvas" ref={host} />
      <nav class="views" aria-label="view">
        {views.map(([name, word]) => (
          <button key={name} aria-pressed={kind === name} onClick={() => handle.setView(name)}>
            {word}
          </button>
        ))}
        <button aria-pressed={screen.current?.cut ?? true} onClick={() => handle.cut()}
          title="cut walls low (W)">Cut walls</button>
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
    <ul class="legend" aria-label="legend">
      {[...colors].map(([name, color]) => (
        <li key={name}><i style={{ background: color }} />{spoken(name)}</li>
      ))}
      <li><i class="plan" />plan</li>
      <li><i class="others" />others</li>
    </ul>
  );
}
