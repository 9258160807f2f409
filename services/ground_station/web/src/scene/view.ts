// The 3-D scene: world ENU, z up. Drawn only when it is shown and something changed.
import {
  AmbientLight, Color, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import type { Vehicle } from "../store/state.ts";
import type { Session } from "../ui/session.ts";
import { groundGrid } from "./grid.ts";
import { Pace } from "./pace.ts";
import { VehicleView } from "./vehicle_view.ts";

const cutHeight_m = 1.1;

export type ViewKind = "orbit" | "follow" | "top";

const longest_ms = 500; // what grows old is drawn so without anything new

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
  private readonly grid = groundGrid();
  private readonly vehicles = new Map<string, VehicleView>();
  private readonly labels = new Map<string, HTMLElement>();
  private readonly focus = new Vector3();
  private readonly corner = new Vector3(); // of a label
  private readonly pace: Pace;
  private readonly observer = new ResizeObserver(() => this.fit());
  private size = { width: 0, height: 0 }; // kept, as asking for it costs a layout
  private generation = -1;
  private placed = false;
  private request = 0;
  private stirred = true; // the camera or the canvas
  private drawnCut = true;
  private drawnFresh = -1;
  private drawn_ms = 0;
  private frames = 0;
  private wantedAll = true; // none of the last second's frames was left out as nothing had changed
  private script_ms = 0; // of these frames
  private counted_ms = performance.now();

  constructor(private readonly session: Session, private readonly host: HTMLElement) {
    const slow = drawsInSoftware();
    this.renderer = new WebGLRenderer({ antialias: !slow && devicePixelRatio < 2 });
    this.pace = new Pace(slow ? 1 : Math.min(devicePixelRatio, 2));
    this.renderer.setPixelRatio(this.pace.ratio);
    host.prepend(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.maxDistance = 120;
    this.controls.addEventListener("change", () => (this.stirred = true));
    this.scene.background = new Color("#0b1015");
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
    this.stirred = true;
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
    if (this.size.width === 0 || !this.pace.isDue(now_ms)) return;
    if (this.isOld(now_ms)) this.update();
    this.moveCamera();
    if (this.stirred) this.draw(now_ms);
    else this.wantedAll = false;
    this.script_ms += performance.now() - now_ms;
    this.count(now_ms);
  };

  private isOld(now_ms: number): boolean {
    const { fresh } = this.session;
    if (fresh === this.drawnFresh && this.cut === this.drawnCut &&
      now_ms - this.drawn_ms < longest_ms) return false;
    this.drawnFresh = fresh;
    this.drawnCut = this.cut;
    return this.stirred = true;
  }

  private draw(now_ms: number): void {
    this.stirred = false;
    this.drawn_ms = now_ms;
    this.frames++;
    this.renderer.render(this.scene, this.camera);
    this.placeLabels();
    if (this.placed && !this.host.dataset["first"]) this.host.dataset["first"] = now_ms.toFixed(0);
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    this.size = { width, height };
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.stirred = true;
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
  }

  private clear(generation: number): void {
    this.generation = generation;
    this.vehicles.forEach((view) => this.scene.remove(view.group));
    this.vehicles.clear();
    this.labels.forEach((label) => label.remove());
    this.labels.clear();
  }

  private moveCamera(): void {
    if (this.session.vehicle) this.follow(this.session.vehicle);
    this.controls.update(); // tells if it moved
  }

  private follow(vehicle: Vehicle): void {
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
    const elapsed_ms = now_ms - this.counted_ms;
    if (elapsed_ms < 1000) return;
    const fps = (1000 * this.frames) / elapsed_ms;
    const { triangles, calls } = this.renderer.info.render;
    Object.assign(this.host.dataset, { fps: fps.toFixed(1), triangles, calls,
      script: (this.script_ms / Math.max(1, this.frames)).toFixed(2),
      ratio: this.renderer.getPixelRatio().toFixed(2) });
    if (this.wantedAll) this.pace.adapt(fps);
    if (this.pace.ratio !== this.renderer.getPixelRatio()) {
      this.renderer.setPixelRatio(this.pace.ratio);
      this.stirred = true;
    }
    this.wantedAll = true;
    this.script_ms = this.frames = 0;
    this.counted_ms = now_ms;
  }
}
