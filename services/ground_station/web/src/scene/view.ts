// The 3-D scene: world ENU, z up. Draws at most thirty times a second, and only when shown.
import {
  AmbientLight, Color, DirectionalLight, GridHelper, PerspectiveCamera, Scene, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import type { Vehicle } from "../store/state.ts";
import type { Session } from "../ui/session.ts";
import { VehicleView } from "./vehicle_view.ts";

const cutHeight_m = 1.1;

export type ViewKind = "orbit" | "follow" | "top";

const period_ms = 1000 / 30;
const slowPeriod_ms = 1000 / 12; // where even coarse pictures are too much

// Without a graphics card smooth edges cost more than they are worth.
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class SceneView {
  kind: ViewKind = "follow";
  cut = true; // walls, so that they hide nothing
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(50, 1, 0.1, 300);
  private readonly controls: OrbitControls;
  private readonly grid = new GridHelper(80, 80, "#4a5b6a", "#344250");
  private readonly vehicles = new Map<string, VehicleView>();
  private readonly labels = new Map<string, HTMLElement>();
  private readonly focus = new Vector3();
  private readonly corner = new Vector3(); // of a label
  private readonly finest: number; // pixels a CSS pixel
  private readonly observer = new ResizeObserver(() => this.fit());
  private size = { width: 0, height: 0 }; // kept, as asking for it costs a layout
  private generation = -1;
  private placed = false;
  private period_ms = period_ms;
  private request = 0;
  private steady = 0; // seconds in which the slow pace was kept
  private drawn_ms = 0;
  private frames = 0;
  private script_ms = 0; // of these frames
  private counted_ms = performance.now();

  constructor(private readonly session: Session, private readonly host: HTMLElement) {
    const slow = drawsInSoftware();
    this.renderer = new WebGLRenderer({ antialias: !slow && devicePixelRatio < 2 });
    this.finest = slow ? 1 : Math.min(devicePixelRatio, 2);
    this.renderer.setPixelRatio(this.finest);
    host.prepend(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.maxDistance = 120;
    this.scene.background = new Color("#0b1015");
    this.grid.rotation.x = Math.PI / 2;
    const sun = new DirectionalLight("#ffffff", 2);
    sun.position.set(4, -6, 10);
    this.scene.add(this.grid, new AmbientLight("#ffffff", 1.2), sun);
    this.setView("follow");
    this.observer.observe(host);
    this.fit();
    this.loop();
  }

  /** Follow and top move with the chosen vehicle; orbit stays. The mouse turns and zooms in all. */
  setView(kind: ViewKind): void {
    this.kind = kind;
    this.placed = false;
    this.period_ms = period_ms;
    this.controls.enableRotate = kind !== "top";
    this.host.dataset["view"] = kind;
  }

  destroy(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    this.labels.forEach((label) => label.remove());
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }

  private readonly loop = (): void => {
    this.request = requestAnimationFrame(this.loop);
    const now_ms = performance.now();
    if (now_ms - this.drawn_ms < this.period_ms - 4 || this.size.width === 0) return;
    this.drawn_ms = now_ms;
    this.update();
    this.renderer.render(this.scene, this.camera);
    this.placeLabels();
    this.script_ms += performance.now() - now_ms;
    if (this.placed && !this.host.dataset["first"]) this.host.dataset["first"] = now_ms.toFixed(0);
    this.count(now_ms);
  };

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    this.size = { width, height };
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  private update(): void {
    const { state, vehicle: chosen, generation } = this.session;
    if (generation !== this.generation) this.clear(generation);
    for (const vehicle of state.vehicles.values()) {
      let view = this.vehicles.get(vehicle.name);
      if (!view) {
        view = new VehicleView(vehicle);
        this.vehicles.set(vehicle.name, view);
        this.scene.add(view.group);
      }
      view.update(state, vehicle, vehicle === chosen, this.cut ? cutHeight_m : Infinity);
    }
    if (chosen) this.moveCamera(chosen);
    this.controls.update();
  }

  private clear(generation: number): void {
    this.generation = generation;
    this.vehicles.forEach((view) => this.scene.remove(view.group));
    this.vehicles.clear();
    this.labels.forEach((label) => label.remove());
    this.labels.clear();
  }

  private moveCamera(vehicle: Vehicle): void {
    const p = vehicle.latest["odometry"]?.message.pose.pose.position;
    if (!p) return;
    const target = vehicle.latest["target/state"]?.message;
    const q = target && target.status !== 0 ? target.position_m : [p.x, p.y, p.z];
    const focus = new Vector3((p.x + q[0]!) / 2, (p.y + q[1]!) / 2, 1);
    if (!this.placed) this.place(focus, new Vector3(p.x - q[0]!, p.y - q[1]!, 0));
    const move = focus.clone().sub(this.focus);
    if (this.kind !== "orbit") {
      if (move.length() < 5) move.multiplyScalar(0.12); // smoothly, but not across the world
      this.camera.position.add(move);
      this.controls.target.add(move);
      this.focus.add(move);
    }
    this.grid.position.set(Math.round(focus.x), Math.round(focus.y), 0);
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

  private placeLabels(): void {
    const { width, height } = this.size;
    for (const vehicle of this.session.state.vehicles.values()) {
      const p = vehicle.latest["odometry"]?.message.pose.pose.position;
      if (!p) continue;
      let label = this.labels.get(vehicle.name);
      if (!label) {
        label = document.createElement("span");
        label.className = "label";
        label.textContent = vehicle.name;
        this.host.append(label);
        this.labels.set(vehicle.name, label);
      }
      const at = this.corner.set(p.x, p.y, p.z + 0.4).project(this.camera);
      const [x, y] = [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
      const hidden = at.z > 1 || Math.abs(at.x) > 1.1 || Math.abs(at.y) > 1.1;
      if (label.hidden !== hidden) label.hidden = hidden;
      if (!hidden) label.style.transform =
        `translate(${x.toFixed(0)}px, ${y.toFixed(0)}px) translate(-50%, -100%)`;
    }
  }

  private count(now_ms: number): void {
    this.frames++;
    if (now_ms - this.counted_ms < 1000) return;
    this.host.dataset["fps"] = ((1000 * this.frames) / (now_ms - this.counted_ms)).toFixed(1);
    this.host.dataset["triangles"] = `${this.renderer.info.render.triangles}`;
    this.host.dataset["calls"] = `${this.renderer.info.render.calls}`;
    this.host.dataset["script"] = (this.script_ms / this.frames).toFixed(2);
    this.host.dataset["ratio"] = this.renderer.getPixelRatio().toFixed(2);
    this.script_ms = 0;
    this.adapt((1000 * this.frames) / (now_ms - this.counted_ms));
    this.frames = 0;
    this.counted_ms = now_ms;
  }

  // Coarser where the machine cannot keep up, finer again where it can.
  private adapt(fps: number): void {
    const ratio = this.renderer.getPixelRatio();
    this.steady = this.period_ms === slowPeriod_ms && fps > 11 ? this.steady + 1 : 0;
    if (fps < 10 && ratio <= 0.5) this.period_ms = slowPeriod_ms;
    else if (this.steady >= 4) this.period_ms = period_ms; // perhaps it can now
    const wanted = fps < 12 ? Math.max(0.5, 0.8 * ratio)
      : fps > 27 ? Math.min(this.finest, 1.1 * ratio) : ratio;
    if (Math.abs(wanted - ratio) > 0.01) this.renderer.setPixelRatio(wanted);
  }
}
