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
import { FlyPanel } from "../fly/panel.tsx";
import { ChoiceDialog, ChoiceLine } from "../picture/choice.tsx";
import { PicturePanel, whyNone } from "../picture/panel.tsx";
import { Plots } from "../plots/panel.tsx";
import { ScenePanel, type SceneHandle } from "../scene/panel.tsx";
import { useNarrow, useSession } from "./hooks.ts";
import { Icon } from "./icon.tsx";
import { keyHelp, listenToKeys } from "./keys.ts";
import { keepLayout, keptLayout, type Layout } from "./layout.ts";
import { openRecording } from "./open_recording.ts";
import type { Session } from "./session.ts";
import { chooseLanguage, languages, said, t } from "./words.ts";

const tabs = [said("Events"), said("Diagnostics"), said("Topics"), said("Recordings"),
  said("Control"), said("Fly")];
const narrowTabs = [said("Scene"), said("Picture"), said("Plots"), ...tabs];
type Tab = string;

function TabContent({ tab, session }: { tab: Tab; session: Session }) {
  if (tab === "Fly") return <FlyPanel session={session} />;
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
          {t(name)}{name === "Events" && open > 0 ? <b class="count">{open}</b> : null}
        </button>
      ))}
    </nav>
  );
}

function LanguageMenu() {
  const [known, setKnown] = useState<[string, string][]>([]);
  useEffect(() => void languages().then(setKnown), []);
  if (known.length < 2) return null;
  return (
    <label>{t("language")} <select value={document.documentElement.lang}
      onChange={(event) => chooseLanguage(event.currentTarget.value)}>
      {known.map(([code, name]) => (
        <option key={code} value={code}>{name}</option>
      ))}
    </select></label>
  );
}

function Help({ close }: { close(): void }) {
  return (
    <dialog open class="help" aria-label={t("keys")}>
      <button class="quiet" aria-label={t("close")} onClick={close}><Icon name="close" /></button>
      <h2>{t("Keys")}</h2>
      <dl>{keyHelp.map(([key, what]) => [<dt>{t(key)}</dt>, <dd>{t(what)}</dd>])}</dl>
      <LanguageMenu />
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

function useLayout(): [Layout, (layout: Layout) => void] {
  const [layout, setLayout] = useState<Layout>(keptLayout());
  return [layout, (chosen) => {
    keepLayout(chosen);
    setLayout(chosen);
  }];
}

/** Scene and picture: one of them large, the other inset, or the scene alone. */
function Stage({ session, scene, layout, setLayout }: { session: Session; scene: SceneHandle;
  layout: Layout; setLayout(layout: Layout): void }) {
  return (
    <div class={`stage with-${layout}`}>
      <ScenePanel session={session} handle={scene} />
      {layout === "scene" ? (
        <button class="showpicture" onClick={() => setLayout("inset")}>{t("Picture")}</button>
      ) : (
        <PicturePanel session={session} layout={layout} hide={() => setLayout("scene")}
          swap={() => setLayout(layout === "inset" ? "picture" : "inset")} />
      )}
      <Readout session={session} />
      <ChoiceDialog session={session} />
    </div>
  );
}

/** On narrow screens the picture has a tab of its own. */
function NarrowPicture({ session }: { session: Session }) {
  return (
    <div class={`stage alone ${whyNone(session) ? "" : "has"}`}>
      <PicturePanel session={session} layout="picture" />
      <ChoiceLine session={session} />
      <ChoiceDialog session={session} />
    </div>
  );
}

export function Page({ session }: { session: Session }) {
  useSession(session);
  useDroppedFiles(session);
  const narrow = useNarrow();
  const [tab, setTab] = useState<Tab>("Events");
  const [narrowTab, setNarrowTab] = useState<Tab>("Scene");
  const [help, setHelp] = useState(false);
  const [layout, setLayout] = useLayout();
  const scene = useRef<SceneHandle>({ setView: () => {}, cut: () => {} }).current;
  const stop = useRef<(pressed: boolean) => void>(() => {});
  const mark = useRef<() => void>(() => {});
  const picture = useRef<() => void>(() => {});
  picture.current = () => {
    const layouts: Layout[] = ["inset", "picture", "scene"];
    setLayout(layouts[(layouts.indexOf(layout) + 1) % 3]!);
    setNarrowTab("Picture");
  };
  useEffect(() => listenToKeys(session, {
    view: (kind) => scene.setView(kind),
    cut: () => scene.cut(),
    tab: (i) => {
      setTab(tabs[i]!);
      setNarrowTab(tabs[i]!);
    },
    picture: () => picture.current(),
    bookmark: () => mark.current(),
    stop: (pressed) => stop.current(pressed),
    help: () => setHelp((shown) => !shown),
  }), []);
  const stopButton = <StopButton session={session} press={stop} />;
  const shown = narrow ? narrowTab : tab;
  const first = narrow && !["Scene", "Picture", "Plots"].includes(narrowTab);
  return (
    <div class={`page ${narrow ? "narrow" : "wide"} ${session.replay ? "replaying" : ""}`}>
      <TopBar session={session} stop={narrow ? null : stopButton} help={() => setHelp(true)} />
      <VehicleStrip session={session} />
      {narrow && narrowTab === "Scene" ? (
        <div class="stage">
          <ScenePanel session={session} handle={scene} />
          <Readout session={session} />
          <ChoiceDialog session={session} />
        </div>
      ) : null}
      {narrow && narrowTab === "Picture" ? <NarrowPicture session={session} /> : null}
      {narrow ? null : (
        <Stage session={session} scene={scene} layout={layout} setLayout={setLayout} />
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
