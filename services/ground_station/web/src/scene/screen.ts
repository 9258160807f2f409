// SPDX-License-Identifier: Apache-2.0
// The page's side of the scene: the canvas, what is done to it, the labels over it, and its news.
import type { Tapped } from "../picture/people.tsx";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { SceneFeed } from "./feed.ts";
import { GroundFeed } from "./ground_feed.ts";
import type { Counts, FromScene, InputEvent, Label, ToScene, ViewKind } from "./messages.ts";

const longest_ms = 500; // what grows old is drawn so without anything new
const groundPeriod_ms = 1000;
const slow_ms = 8; // for a picture: software draws it, and the rest of the page has less time
const inputs = ["pointerdown", "pointermove", "pointerup", "pointercancel", "wheel"];

const start = (): Worker =>
  new Worker(new URL("scene_worker.js", import.meta.url), { type: "module" });

export class SceneScreen {
  onTap: (tapped: Tapped) => void = () => {};
  kind: ViewKind = "follow";
  cut = true; // walls, so that they hide nothing
  private readonly worker = start();
  private readonly canvas = document.createElement("canvas");
  private readonly feed = new SceneFeed();
  private readonly ground: GroundFeed;
  private readonly labels = new Map<string, HTMLElement>();
  private readonly observer = new ResizeObserver(() => this.fit());
  private asked = true;
  private told = { fresh: -1, at_ms: 0, generation: -1 };
  private grounded_ms = 0; // when the map was looked for last
  private request = 0;

  constructor(private readonly session: Session, private readonly host: HTMLElement) {
    this.ground = new GroundFeed(session, (pieces) =>
      this.tell({ kind: "ground", pieces }, pieces.map(({ bitmap }) => bitmap)));
    host.prepend(this.canvas);
    this.worker.onmessage = ({ data }: MessageEvent<FromScene>) => this.hear(data);
    this.worker.onerror = ({ message }) => this.fail(message || "the scene's worker did not start");
    const canvas = this.canvas.transferControlToOffscreen();
    this.tell({ kind: "begin", canvas, ratio: devicePixelRatio }, [canvas]);
    for (const type of inputs) this.canvas.addEventListener(type, this.hand, { passive: false });
    this.canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    this.observer.observe(host);
    this.look();
    this.loop();
  }

  setView(kind: ViewKind): void {
    this.kind = kind;
    this.look();
  }
  toggleCut(): void {
    this.cut = !this.cut;
    this.look();
  }

  destroy(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    this.worker.terminate();
    this.clearLabels();
    this.canvas.remove();
  }

  private tell(message: ToScene, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }

  private look(): void {
    this.host.dataset["view"] = this.kind;
    this.tell({ kind: "look", view: this.kind, cut: this.cut });
  }

  private fit(): void {
    this.tell({ kind: "size", width: this.host.clientWidth, height: this.host.clientHeight });
  }

  // Only when it asks: a scene that is slow is told the newest, not everything.
  private readonly loop = (): void => {
    this.request = requestAnimationFrame(this.loop);
    const { fresh, generation, state } = this.session;
    const now_ms = performance.now();
    if (this.told.generation < 0 && state.vehicles.size === 0) return; // nothing to begin with
    if (!this.asked || (fresh === this.told.fresh && now_ms - this.told.at_ms < longest_ms)) return;
    this.asked = false;
    if (now_ms - this.grounded_ms > groundPeriod_ms) {
      this.grounded_ms = now_ms;
      this.ground.look();
    }
    if (generation !== this.told.generation) this.clearLabels();
    this.told = { fresh, at_ms: now_ms, generation };
    this.tell({ kind: "news", news: this.feed.take(this.session) });
  };

  private readonly hand = (event: Event): void => {
    if (event.type === "wheel") event.preventDefault();
    const { type, pointerId, pointerType, button, clientX, clientY, pageX, pageY, deltaY, deltaMode,
      ctrlKey, metaKey, shiftKey } = event as PointerEvent & WheelEvent;
    if (type === "pointerdown") this.canvas.setPointerCapture(pointerId);
    const rect = this.canvas.getBoundingClientRect();
    const input: InputEvent = { type, pointerId, pointerType, button, clientX: clientX - rect.left,
      clientY: clientY - rect.top, pageX, pageY, deltaY, deltaMode, ctrlKey, metaKey, shiftKey };
    this.tell({ kind: "input", event: input });
  };

  private hear(message: FromScene): void {
    if (message.kind === "ask") this.asked = true;
    else if (message.kind === "counted") this.count(message.counts);
    else if (message.kind === "failed") this.fail(message.reason);
    else {
      message.labels.forEach((label) => this.place(label));
      this.dropOthers(message.labels);
      if (message.placed) this.host.dataset["first"] ??= performance.now().toFixed(0);
    }
  }

  private count(counts: Counts): void {
    Object.assign(this.host.dataset, counts);
    this.session.drawsSlowly = Number(counts.busy) > slow_ms;
  }

  // A body's label is a button: who is tapped can be followed.
  private makeLabel({ name, body }: Label): HTMLElement {
    const label = document.createElement(body ? "button" : "span");
    label.className = body ? "label body" : "label";
    if (body) label.setAttribute("aria-label", t("person {id}", { id: body.id }));
    label.textContent = name;
    this.host.append(label);
    return label;
  }

  private place(told: Label): void {
    const { name, x, y, hidden, body } = told;
    const key = body ? `body ${name}` : name;
    let label = this.labels.get(key);
    if (!label) this.labels.set(key, label = this.makeLabel(told));
    if (body) {
      label.classList.toggle("followed", body.followed);
      label.onclick = () => this.onTap({ who: body, x, y });
    }
    if (label.hidden !== hidden) label.hidden = hidden;
    const at = `translate(${x}px, ${y}px) translate(-50%, -100%)`;
    if (!hidden && label.dataset["at"] !== at) label.style.transform = label.dataset["at"] = at;
  }

  private dropOthers(labels: Label[]): void {
    const told = new Set(labels.map(({ name, body }) => (body ? `body ${name}` : name)));
    for (const [key, label] of this.labels)
      if (!told.has(key)) {
        label.remove();
        this.labels.delete(key);
      }
  }

  private clearLabels(): void {
    this.labels.forEach((label) => label.remove());
    this.labels.clear();
  }

  private fail(reason: string): void {
    this.destroy();
    this.host.textContent = `This browser shows no 3-D: ${reason}`;
  }
}
