// SPDX-License-Identifier: Apache-2.0
// The whole page: bar, vehicles, scene, plots, tables; on narrow screens one of them at a time.
import { useEffect, useRef, useState } from "preact/hooks";

import { ControlPanel } from "../panels/control.tsx";
import { DiagnosticsPanel } from "../panels/diagnostics.tsx";
import { EventsPanel } from "../panels/events.tsx";
import { Readout } from "../panels/readout.tsx";
import { RecordingsPanel } from "../panels/recordings.tsx";
import { ReplayBar } from "../panels/replay_bar.tsx";
import { StopButton } from "../panels/stop.tsx";
import { TopBar } from "../panels/top_bar.tsx";
import { TopicsPanel } from "../panels/topics.tsx";
import { VehicleStrip } from "../panels/vehicle_strip.tsx";
import { Plots } from "../plots/panel.tsx";
import { ScenePanel, type SceneHandle } from "../scene/panel.tsx";
import { useNarrow, useSession } from "./hooks.ts";
import { keyHelp, listenToKeys } from "./keys.ts";
import { openRecording } from "./open_recording.ts";
import type { Session } from "./session.ts";

const tabs = ["Events", "Diagnostics", "Topics", "Recordings", "Control"] as const;
const narrowTabs = ["Scene", "Plots", ...tabs] as const;
type Tab = (typeof narrowTabs)[number];

function TabContent({ tab, session }: { tab: Tab; session: Session }) {
  if (tab === "Events") return <EventsPanel session={session} />;
  if (tab === "Diagnostics") return <DiagnosticsPanel session={session} />;
  if (tab === "Topics") return <TopicsPanel session={session} />;
  if (tab === "Recordings") return <RecordingsPanel session={session} />;
  return <ControlPanel session={session} />;
}

interface TabBarProps { names: readonly Tab[]; tab: Tab; session: Session; choose(tab: Tab): void }

function TabBar({ names, tab, session, choose }: TabBarProps) {
  const open = [...session.state.alarms.values()].filter((a) => !a.acknowledged).length;
  return (
    <nav class="tabs" role="tablist">
      {names.map((name) => (
        <button key={name} role="tab" aria-selected={name === tab} onClick={() => choose(name)}>
          {name}{name === "Events" && open > 0 ? <b class="count">{open}</b> : null}
        </button>
      ))}
    </nav>
  );
}

function Help({ close }: { close(): void }) {
  return (
    <dialog open class="help" onClick={close} aria-label="keys">
      <h2>Keys</h2>
      <dl>{keyHelp.map(([key, what]) => [<dt>{key}</dt>, <dd>{what}</dd>])}</dl>
    </dialog>
  );
}

function useDroppedFiles(session: Session): void {
  useEffect(() => {
    const over = (event: DragEvent): void => event.preventDefault();
    const drop = (event: DragEvent): void => {
      event.preventDefault();
      const file = event.dataTransfer?.files[0];
      if (file) void openRecording(session, file);
    };
    document.addEventListener("dragover", over);
    document.addEventListener("drop", drop);
    return () => {
      document.removeEventListener("dragover", over);
      document.removeEventListener("drop", drop);
    };
  }, []);
}

export function Page({ session }: { session: Session }) {
  useSession(session);
  useDroppedFiles(session);
  const narrow = useNarrow();
  const [tab, setTab] = useState<Tab>("Events");
  const [narrowTab, setNarrowTab] = useState<Tab>("Scene");
  const [help, setHelp] = useState(false);
  const scene = useRef<SceneHandle>({ setView: () => {}, cut: () => {} }).current;
  const stop = useRef<(pressed: boolean) => void>(() => {});
  const mark = useRef<() => void>(() => {});
  useEffect(() => listenToKeys(session, {
    view: (kind) => scene.setView(kind),
    cut: () => scene.cut(),
    tab: (i) => {
      setTab(tabs[i]!);
      setNarrowTab(tabs[i]!);
    },
    bookmark: () => mark.current(),
    stop: (pressed) => stop.current(pressed),
    help: () => setHelp((shown) => !shown),
  }), []);
  const stopButton = <StopButton session={session} press={stop} />;
  const shown = narrow ? narrowTab : tab;
  const first = narrow && narrowTab !== "Scene" && narrowTab !== "Plots";
  return (
    <div class={`page ${narrow ? "narrow" : "wide"} ${session.replay ? "replaying" : ""}`}>
      <TopBar session={session} stop={narrow ? null : stopButton} help={() => setHelp(true)} />
      <VehicleStrip session={session} />
      {narrow && narrowTab !== "Scene" ? null : (
        <div class="stage">
          <ScenePanel session={session} handle={scene} />
          <Readout session={session} />
        </div>
      )}
      {narrow && narrowTab !== "Plots" ? null : <Plots session={session} />}
      {narrow && !first ? null : (
        <section class="tables">
          {narrow ? null : <TabBar names={tabs} tab={tab} session={session} choose={setTab} />}
          <div class="table" role="tabpanel" aria-label={shown}>
            <TabContent tab={shown} session={session} />
          </div>
        </section>
      )}
      {session.replay ? (
        <ReplayBar key={session.replay.recording.name} session={session} mark={mark} />
      ) : null}
      {narrow ? (
        <footer class="bottom">
          {stopButton}
          <TabBar names={narrowTabs} tab={narrowTab} session={session} choose={setNarrowTab} />
        </footer>
      ) : null}
      {help ? <Help close={() => setHelp(false)} /> : null}
    </div>
  );
}
