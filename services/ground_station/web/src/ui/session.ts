// SPDX-License-Identifier: Apache-2.0
// What the page does: the live link, perhaps a replay, and which of the two is shown.
import { Intake } from "../data/intake.ts";
import type { LiveLink } from "../data/live.ts";
import type { Recording } from "../data/recording.ts";
import { Replay } from "../data/replay.ts";
import type { GroundMap } from "../ground/ground_map.ts";
import type { RawSample } from "../data/sample.ts";
import { byName, pictureTopic, videoTopic } from "../data/topics.ts";
import { VideoChoice } from "../picture/video_choice.ts";
import { type Input, reduce } from "../store/reduce.ts";
import { makeState, type State, type Vehicle } from "../store/state.ts";
import { beginsWithPicture } from "./layout.ts";
import { Operator } from "./operator.ts";
import { AlarmSound } from "./sound.ts";

interface Stage { state: State; intake: Intake }

// A page that stood still finds its samples waiting: it takes them before it calls anything old.
const late_ms = 500;
const longestStart_ms = 800;
const schemasAFrame = 2; // the first picture is not to wait for all

function makeStage(): Stage {
  const state = makeState();
  const intake = new Intake((text) => reduce(state, { kind: "problem", text }));
  return { state, intake };
}

function feed(stage: Stage, samples: RawSample[], now_s: number, schemas = Infinity): void {
  for (const sample of stage.intake.take(samples, schemas)) reduce(stage.state, { kind: "sample", sample });
  reduce(stage.state, { kind: "time", now_s });
}

export class Session {
  readonly operator = new Operator();
  readonly sound = new AlarmSound();
  readonly video = new VideoChoice();
  replay: Replay | null = null;
  chosen = ""; // vehicle
  watching = beginsWithPicture(); // the chosen vehicle's picture is seen
  span_s = 30; // of the plots
  /** The first picture is there, or none will be soon: what takes the machine long may begin. */
  readonly settled: Promise<true>;
  settle: () => void = () => {};
  ground: GroundMap | null = null; // the station's map
  fresh = 0; // grows when there is something new to draw
  generation = 0; // of the shown state: the scene and the plots begin anew
  drawsSlowly = false; // the scene takes much of the machine
  message = { text: "", bad: false }; // the answer to the last order, for some seconds
  private sorted: { of: unknown; list: Vehicle[] } = { of: null, list: [] };
  private fed_ms = performance.now();
  private readonly live = makeStage();
  private replayed: Stage = makeStage();
  private readonly listeners = new Set<() => void>();

  constructor(private readonly link: LiveLink, readonly pictures: LiveLink) {
    const { state } = this.live;
    this.settled = new Promise((resolve) => (this.settle = () => resolve(true)));
    setTimeout(() => this.settle(), longestStart_ms);
    void this.settled.then(() => this.loadGround());
    link.onLink((open, reason) => this.tell({ kind: "link", open, reason, now_s: link.now_s() }));
    link.onProblem = pictures.onProblem = (text) => reduce(state, { kind: "problem", text });
    pictures.onOffer(() => {
      this.wantPicture();
      if (!this.watching || pictures.offering().length === 0) this.settle();
    });
  }

  /** The state that is shown: live, or the recording's. */
  get state(): State {
    return this.replay ? this.replayed.state : this.live.state;
  }
  /** What the station says now, also while a recording is shown. */
  get liveState(): State {
    return this.live.state;
  }
  /** Of what is shown, now: the state's own is as old as its last frame. */
  get now_s(): number {
    return this.replay ? this.replay.time_s() : this.link.now_s();
  }
  get vehicle(): Vehicle | undefined {
    return this.state.vehicles.get(this.chosen) ?? this.vehicles[0];
  }
  /** In the order of their names, whichever was heard first. */
  get vehicles(): Vehicle[] {
    const { vehicles } = this.state;
    if (this.sorted.of !== vehicles || this.sorted.list.length !== vehicles.size)
      this.sorted = { of: vehicles, list: [...vehicles.values()].sort((a, b) =>
        byName(a.name, b.name)) };
    return this.sorted.list;
  }

  /** The vehicle that orders go to: of the live ones, also while a recording is shown. */
  get commanded(): string {
    const { vehicles, station } = this.live.state;
    const name = this.vehicle?.name;
    if (name !== undefined && vehicles.has(name)) return name;
    return vehicles.keys().next().value ?? station?.message.vehicles[0]?.name ?? "";
  }

  /** Of the chosen vehicle, or of who offers pictures before anything is heard. */
  private pictured(topic: string): string {
    return `/${this.vehicle?.name ?? this.pictures.offering()[0] ?? ""}/${topic}`;
  }
  /** The topic of its pictures. */
  get picture(): string {
    return this.pictured(pictureTopic);
  }
  /** There is a video of it, in what is shown. */
  get hasVideo(): boolean {
    const topic = this.pictured(videoTopic);
    return this.replay ? this.replay.recording.topics().includes(topic) : this.pictures.offers(topic);
  }
  get showsVideo(): boolean {
    return this.video.on && this.hasVideo;
  }

  // Images until the video runs.
  private wantPicture(): void {
    const watched = this.watching && !this.replay && !document.hidden;
    const videos = this.showsVideo ? [this.pictured(videoTopic)] : [];
    const images = this.showsVideo && this.video.runs ? [] : [this.picture];
    this.pictures.want(watched ? [...images, ...videos] : []);
  }

  /** Once a frame. */
  frame(): void {
    const late = performance.now() - this.fed_ms > late_ms;
    this.fed_ms = performance.now();
    this.wantPicture();
    if (late) setTimeout(() => this.feedLive(), 50);
    else this.feedLive();
    if (this.replay) this.feedReplay(this.replay);
    this.sound.hear(this.live.state);
  }

  /** Asked for again where a token was missing. */
  async loadGround(): Promise<void> {
    if (!this.ground) this.ground = await this.operator.groundMap();
    this.changed();
  }

  choose(name: string): void {
    this.chosen = name;
    this.changed();
  }
  startReplay(recording: Recording): void {
    this.replay = new Replay(recording);
    this.beginAnew();
    this.replay.play(true);
    this.changed();
  }
  endReplay(): void {
    this.replay = null;
    this.generation++;
    this.changed();
  }
  tell(input: Input): void {
    reduce(input.kind === "acknowledge" ? this.state : this.live.state, input);
    this.changed();
  }

  notice(text: string, bad = false): void {
    this.message = { text, bad };
    this.changed();
    if (text) setTimeout(() => this.message.text === text && this.notice(""), 8000);
  }

  /** Called when something is to be drawn anew at once; else panels draw four times a second. */
  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
  changed(): void {
    this.fresh++;
    this.listeners.forEach((listener) => listener());
  }

  private feedLive(): void {
    const samples = [...this.pictures.take(), ...this.link.take()];
    if (samples.length > 0 && !this.replay) this.fresh++;
    feed(this.live, samples, this.link.now_s(), document.hidden ? Infinity : schemasAFrame);
  }
  private feedReplay(replay: Replay): void {
    const { restart, now_s, samples } = replay.take();
    if (restart) this.beginAnew();
    if (restart || samples.length > 0) this.fresh++;
    feed(this.replayed, samples, now_s);
  }

  // Acknowledged alarms stay so through a seek.
  private beginAnew(): void {
    const acknowledged = [...this.replayed.state.alarms.values()].filter((a) => a.acknowledged);
    this.replayed = makeStage();
    for (const alarm of acknowledged) this.replayed.state.alarms.set(alarm.key, alarm);
    this.generation++;
  }
}
