// SPDX-License-Identifier: Apache-2.0
// The 3-D scene: world ENU, z up. Drawn only when something changed.
import {
  AmbientLight, Color, DirectionalLight, LinearSRGBColorSpace, PerspectiveCamera, Scene, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { Track } from "../data/words.ts";
import { stale_s } from "../store/watch.ts";
import { Ground } from "./ground.ts";
import { groundGrid, gridStep_m } from "./grid.ts";
import { Known, type SeenVehicle } from "./known.ts";
import type { FromScene, Label, ToScene, ViewKind } from "./messages.ts";
import { Pace } from "./pace.ts";
import { Surface } from "./surface.ts";
import { Tally } from "./tally.ts";
import { VehicleView } from "./vehicle_view.ts";

const cutHeight_m = 1.1;
const idle_ms = 200; // so long without news: there are none

// Without a graphics card smooth edges cost more than they are worth.
function drawsInSoftware(): boolean {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

const slow = drawsInSoftware(); // takes its time: asked before there is a canvas

export class SceneView {
  private kind: ViewKind = "follow";
  private cut = true;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(50, 1, 0.1, 300);
  private readonly surface = new Surface();
  private readonly controls: OrbitControls;
  private readonly ground = new Ground();
  private readonly grid = groundGrid();
  private readonly known = new Known();
  private readonly vehicles = new Map<string, VehicleView>();
  private readonly focus = new Vector3();
  private readonly corner = new Vector3(); // of a label
  private readonly pace: Pace;
  private generation = -1;
  private placed = false;
  private request = 0;
  private stirred = true; // the camera or the canvas
  private updated = true; // what is drawn is what is known
  private heard_ms = 0; // the last news
  private readonly tally = new Tally();

  constructor(canvas: OffscreenCanvas, ratio: number,
              private readonly tell: (message: FromScene) => void) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !slow && ratio < 2 });
    this.renderer.outputColorSpace = LinearSRGBColorSpace; // see plain_colors.ts
    this.pace = new Pace(slow ? 1 : Math.min(ratio, 2));
    this.renderer.setPixelRatio(this.pace.ratio);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.surface as unknown as HTMLElement);
    this.controls.maxDistance = 120;
    this.controls.addEventListener("change", () => (this.stirred = true));
    this.scene.background = new Color("#0b1015");
    const sun = new DirectionalLight("#ffffff", 1.2);
    sun.position.set(4, -6, 10);
    this.scene.add(this.ground.group, this.grid, new AmbientLight("#ffffff", 2), sun);
    this.loop();
  }

  take(message: Exclude<ToScene, { kind: "begin" }>): void {
    if (message.kind === "input") this.surface.hand(message.event);
    else if (message.kind === "size") this.fit(message.width, message.height);
    else if (message.kind === "look") this.look(message.view, message.cut);
    else if (message.kind === "ground") {
      this.ground.set(message.pieces);
      this.stirred = true;
    }
    else {
      this.known.apply(message.news);
      this.heard_ms = performance.now();
      this.updated = false;
    }
  }

  /** Draws no more by itself: for probe/scene.mjs. */
  halt(): void {
    cancelAnimationFrame(this.request);
  }

  /** Follow and top move with the chosen vehicle; orbit stays. The mouse turns and zooms in all. */
  private look(kind: ViewKind, cut: boolean): void {
    if (cut !== this.cut) this.updated = false;
    this.cut = cut;
    if (kind === this.kind) return;
    this.kind = kind;
    this.placed = false;
    this.stirred = true;
    this.controls.enableRotate = kind !== "top";
  }

  private readonly loop = (): void => {
    this.request = requestAnimationFrame(this.loop);
    const now_ms = performance.now();
    if (this.surface.clientWidth === 0 || !this.pace.isDue(now_ms)) return;
    if (!this.updated) this.update();
    this.moveCamera();
    if (this.stirred) this.draw(now_ms);
    else if (now_ms - this.heard_ms > idle_ms) this.tally.wantedAll = false;
    this.count(now_ms);
  };

  private draw(begin_ms: number): void {
    this.stirred = false;
    this.camera.updateMatrixWorld();
    this.tell({ kind: "drawing", labels: this.labels(), placed: this.placed }); // shown with it
    this.renderer.render(this.scene, this.camera);
    this.tally.frame(begin_ms);
  }

  private fit(width: number, height: number): void {
    Object.assign(this.surface, { clientWidth: width, clientHeight: height });
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.stirred = true;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  // The next news are asked for at once, so that they are there for the next picture.
  private update(): void {
    this.tell({ kind: "ask" });
    this.updated = this.stirred = true;
    const { known } = this;
    if (known.generation !== this.generation) this.clear();
    for (const vehicle of known.vehicles.values()) {
      let view = this.vehicles.get(vehicle.name);
      if (!view) {
        view = new VehicleView(vehicle.index);
        this.vehicles.set(vehicle.name, view);
        this.scene.add(view.group);
      }
      view.update(known.now_s, vehicle, vehicle.name === known.chosen);
    }
    this.updateWalls();
  }

  // Of one vehicle a picture: those of all at once would hold it up.
  private updateWalls(): void {
    for (const [name, view] of this.vehicles) {
      const vehicle = this.known.vehicles.get(name);
      if (!vehicle || !view.updateWalls(vehicle, this.cut ? cutHeight_m : Infinity)) continue;
      this.vehicles.delete(name);
      this.vehicles.set(name, view); // the others come first
      this.updated = false; // there may be more
      return;
    }
  }

  private clear(): void {
    this.generation = this.known.generation;
    this.vehicles.forEach((view) => this.scene.remove(view.group));
    this.vehicles.clear();
  }

  private moveCamera(): void {
    const chosen = this.known.vehicles.get(this.known.chosen);
    if (chosen) this.follow(chosen);
    this.controls.update(); // tells if it moved
  }

  private follow(vehicle: SeenVehicle): void {
    const p = vehicle.latest["odometry"]?.message.position;
    if (!p) return;
    const target = vehicle.latest["target/state"]?.message;
    const q = target && target.status !== Track.none ? target : p;
    const focus = new Vector3((p.x + q.x) / 2, (p.y + q.y) / 2, 1);
    if (!this.placed) this.place(focus, new Vector3(p.x - q.x, p.y - q.y, 0));
    const move = focus.clone().sub(this.focus);
    if (this.kind !== "orbit") {
      if (move.length() < 5) move.multiplyScalar(0.12); // smoothly, but not across the world
      this.camera.position.add(move);
      this.controls.target.add(move);
      this.focus.add(move);
    }
    const onGrid = (x: number): number => gridStep_m * Math.round(x / gridStep_m);
    this.grid.position.set(onGrid(focus.x), onGrid(focus.y), 0);
  }

  private place(focus: Vector3, behind: Vector3): void {
    this.placed = true;
    this.focus.copy(focus);
    this.controls.target.copy(focus);
    const back = behind.lengthSq() > 0.01 ? behind.normalize() : new Vector3(-1, 0, 0);
    const offset = this.kind === "top" ? new Vector3(0, -0.01, 13)
      : back.multiplyScalar(4.5).applyAxisAngle(this.camera.up, 0.6).add(new Vector3(0, 0, 4.5));
    const far = Math.max(1, 1.1 / Math.sqrt(this.camera.aspect)); // upright screens see less
    this.camera.position.copy(focus).addScaledVector(offset, far);
  }

  private labelAt(x: number, y: number, z: number): Omit<Label, "name"> {
    const { clientWidth: width, clientHeight: height } = this.surface;
    const at = this.corner.set(x, y, z).project(this.camera);
    const hidden = at.z > 1 || Math.abs(at.x) > 1.1 || Math.abs(at.y) > 1.1;
    return { hidden, x: Math.round(((at.x + 1) / 2) * width),
      y: Math.round(((1 - at.y) / 2) * height) };
  }

  private labels(): Label[] {
    const vehicles = [...this.known.vehicles.values()].flatMap(({ name, latest }): Label[] => {
      const p = latest["odometry"]?.message.position;
      return p ? [{ name, ...this.labelAt(p.x, p.y, p.z + 0.4) }] : [];
    });
    return [...vehicles, ...this.bodyLabels()];
  }

  // Of the chosen vehicle, as orders go to it.
  private bodyLabels(): Label[] {
    const { latest } = this.known.vehicles.get(this.known.chosen) ?? {};
    const [bodies, pose] = [latest?.["bodies"], latest?.["odometry"]?.message.position];
    if (!bodies || !pose || this.known.now_s - bodies.time_s > stale_s) return [];
    return bodies.message.map(({ id, person, followed, x, y, z, height_m }) => ({
      name: `${id}`, ...this.labelAt(x, y, z + height_m + 0.15),
      body: { id, person, followed, distance_m: Math.hypot(x - pose.x, y - pose.y) },
    }));
  }

  private count(now_ms: number): void {
    const second = this.tally.take(now_ms);
    if (!second) return;
    const { fps, script_ms, busy_ms } = second;
    const { triangles, calls } = this.renderer.info.render;
    this.tell({ kind: "counted", counts: { fps: fps.toFixed(1), triangles: `${triangles}`,
      calls: `${calls}`, script: script_ms.toFixed(2), busy: busy_ms.toFixed(1),
      ratio: this.renderer.getPixelRatio().toFixed(2) } });
    if (this.tally.wantedAll) this.pace.adapt(fps, busy_ms);
    this.tally.wantedAll = true;
    if (this.pace.ratio === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(this.pace.ratio);
    this.stirred = true;
  }
}
