import { useEffect, useRef } from "preact/hooks";

import { useModule } from "../ui/hooks.ts";
import type { Session } from "../ui/session.ts";
import type { SceneView, ViewKind } from "./view.ts";

export interface SceneHandle { setView(kind: ViewKind): void; cut(): void }

const views: [ViewKind, string][] = [["follow", "Follow"], ["orbit", "Orbit"], ["top", "Top"]];

export function ScenePanel({ session, handle }: { session: Session; handle: SceneHandle }) {
  const host = useRef<HTMLDivElement>(null);
  const view = useRef<SceneView | null>(null);
  const module = useModule(() => import("./view.ts"));
  useEffect(() => {
    if (!module || !host.current) return;
    try {
      view.current = new module.SceneView(session, host.current);
      Object.assign(host.current, { view: view.current }); // for probe/scene.mjs
    } catch (error) {
      host.current.textContent = `This browser shows no 3-D: ${(error as Error).message}`;
      return;
    }
    return () => view.current?.destroy();
  }, [module]);
  handle.setView = (kind) => {
    view.current?.setView(kind);
    session.changed();
  };
  handle.cut = () => {
    if (view.current) view.current.cut = !view.current.cut;
    session.changed();
  };
  const kind = view.current?.kind ?? "follow";
  return (
    <section class="scene" aria-label="scene">
      <div class="canvas" ref={host} />
      <nav class="views" aria-label="view">
        {views.map(([name, word]) => (
          <button key={name} aria-pressed={kind === name} onClick={() => handle.setView(name)}>
            {word}
          </button>
        ))}
        <button aria-pressed={view.current?.cut ?? true} onClick={() => handle.cut()}
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
