// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "preact/hooks";

import type { Session } from "../ui/session.ts";
import type { ViewKind } from "./messages.ts";
import { SceneScreen } from "./screen.ts";

export interface SceneHandle { setView(kind: ViewKind): void; cut(): void }

const views: [ViewKind, string][] = [["follow", "Follow"], ["orbit", "Orbit"], ["top", "Top"]];

export function ScenePanel({ session, handle }: { session: Session; handle: SceneHandle }) {
  const host = useRef<HTMLDivElement>(null);
  const screen = useRef<SceneScreen | null>(null);
  useEffect(() => {
    screen.current = new SceneScreen(session, host.current!);
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
      <Legend />
    </section>
  );
}

function Legend() {
  return (
    <ul class="legend" aria-label="legend">
      <li class="c-blue">forward</li>
      <li class="c-orange">turn left</li>
      <li class="c-green">turn right</li>
      <li class="c-pink">decelerate</li>
      <li class="c-plan">plan</li>
    </ul>
  );
}
