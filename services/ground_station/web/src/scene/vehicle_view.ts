// SPDX-License-Identifier: Apache-2.0
// All that is drawn of one vehicle: itself, its person, what it predicts and what it plans.
import { Color, Group } from "three";

import { Track } from "../data/words.ts";
import { age_s } from "../store/state.ts";
import { stale_s } from "../store/watch.ts";
import { blue, colorOf, colorOfRgb, green, orange } from "../ui/palette.ts";
import { Around } from "./around.ts";
import { PersonBody, VehicleBody } from "./bodies.ts";
import { BoundsView } from "./bounds.ts";
import { polytopeEdges } from "./corridor.ts";
import type { SeenVehicle } from "./known.ts";
import { Lost } from "./lost.ts";
import { type Fan, FadingLine, Fans, type Point, Ribbons, Segments } from "./shapes.ts";
import type { Path, Plan, Seat, Sketches } from "./sketch.ts";
import { thin } from "./thin.ts";
import { voxelsOfMap, voxelsOfPoints } from "./voxels.ts";
import { Walls } from "./walls.ts";

const planColor = new Color("#f4f7fa");
const stopColor = "#93a1af"; // where the plan only stops, and its corridor
const tailColor = new Color(stopColor);
const parsed = new Map<string, Color>();
const corridorPeriod_s = 0.2;
const maxPaths = 6;
const ribbonPoints = 64;
const reach_m = 2.5; // to which visible regions are drawn
const ring_m = [2, 3.5] as const; // to which seats are drawn, near and behind
const maxSeats = 16;

function colorNamed(name: string): Color {
  let color = parsed.get(name);
  if (!color) parsed.set(name, color = new Color(name));
  return color;
}

function triples(numbers: Float32Array, z?: number): Point[] {
  return Array.from({ length: numbers.length / 3 }, (_, i): Point =>
    [numbers[3 * i]!, numbers[3 * i + 1]!, z ?? numbers[3 * i + 2]!]);
}

export class VehicleView {
  readonly group = new Group();
  private readonly details = new Group(); // of the chosen vehicle only
  private readonly body: VehicleBody;
  private readonly person = new PersonBody(orange);
  private readonly around = new Around();
  private readonly lost = new Lost();
  private readonly trail: FadingLine;
  private readonly targetTrail = new FadingLine(900, orange);
  private readonly ribbons = new Ribbons(maxPaths + 1, ribbonPoints); // the paths, then the plan
  private shown = { paths: false, plan: false, bodies: false };
  private readonly sectors = new Fans(4);
  private readonly regions = new Fans(64);
  private readonly seats = new Fans(maxSeats);
  private readonly corridor = new Segments(1500, stopColor, 0.5);
  private readonly bounds = new BoundsView();
  private readonly walls = new Walls();
  private drawn = new WeakSet<object>(); // messages whose shapes are up to date
  private corridor_s = -Infinity;
  private trails = "";
  private drawnMap = { of: null as object | null, cut_m: Infinity };

  constructor(index: number) {
    const color = colorOf(index);
    this.body = new VehicleBody(color);
    this.trail = new FadingLine(900, color);
    this.details.add(this.sectors.mesh, this.regions.mesh, this.seats.mesh, this.corridor.mesh,
      this.bounds.group);
    this.group.add(this.body.group, this.person.group, this.trail.mesh, this.targetTrail.mesh,
      this.around.group, this.lost.group, this.ribbons.mesh, this.walls.mesh, this.details);
  }

  /** All but the walls. */
  update(now_s: number, vehicle: SeenVehicle, chosen: boolean): void {
    const { latest } = vehicle;
    this.details.visible = chosen;
    const odometry = latest["odometry"];
    this.body.group.visible = odometry !== undefined;
    if (odometry) this.body.place(odometry.message);
    this.body.setCamera(latest["target/observation"]?.message);
    const target = latest["target/state"];
    this.person.group.visible = target !== undefined;
    if (target) this.person.place(target.message);
    this.drawTrails(vehicle);
    const fresh = (heard: { time_s: number } | undefined): boolean =>
      heard !== undefined && age_s({ now_s }, heard) < stale_s;
    const { "target/prediction": prediction, "plan/trajectory": plan, bodies } = latest;
    this.clearStale(fresh(prediction), fresh(plan), fresh(bodies));
    if (bodies && this.shown.bodies && this.isNew(bodies)) this.around.set(bodies.message);
    if (prediction && this.shown.paths && this.isNew(prediction))
      this.drawPaths(prediction.message);
    if (plan && this.shown.plan && this.isNew(plan)) this.drawPlan(plan.message);
    const search = latest["target/search"];
    if (!fresh(search)) this.lost.set(null);
    else if (this.isNew(search!)) this.lost.set(search!.message);
    if (chosen) this.drawDetails(now_s, vehicle, fresh);
  }

  /** What takes longer than all else; whether there was anything to do. */
  updateWalls({ latest }: SeenVehicle, cut_m: number): boolean {
    const { "map/points": points, "map/local": map } = latest;
    const usePoints = points && (!map || map.time_s - points.time_s < 3);
    const heard = usePoints ? points : map;
    const { drawnMap } = this;
    if (!heard || (heard === drawnMap.of && cut_m === drawnMap.cut_m)) return false;
    this.drawnMap = { of: heard, cut_m };
    this.walls.set(usePoints ? voxelsOfPoints(points.message) : voxelsOfMap(map!.message), cut_m);
    return true;
  }

  private isNew(heard: object): boolean {
    const fresh = !this.drawn.has(heard);
    this.drawn.add(heard);
    return fresh;
  }

  private clearStale(paths: boolean, plan: boolean, bodies: boolean): void {
    if (this.shown.paths && !paths)
      for (let i = 0; i < maxPaths; i++) this.ribbons.clear(i);
    if (this.shown.plan && !plan) this.ribbons.clear(maxPaths);
    if (this.shown.bodies && !bodies) this.around.set([]);
    this.shown = { paths, plan, bodies };
  }

  private drawTrails(vehicle: SeenVehicle): void {
    const key = `${vehicle.trail.version} ${vehicle.targetTrail.version}`;
    if (key === this.trails) return;
    this.trails = key;
    this.trail.set(thin(vehicle.trail.points));
    this.targetTrail.set(thin(vehicle.targetTrail.points));
  }

  private drawPaths(paths: readonly Path[]): void {
    for (let i = 0; i < maxPaths; i++) {
      const path = paths[i];
      if (!path) {
        this.ribbons.clear(i);
        continue;
      }
      const p = Math.min(1, Math.max(0, path.probability));
      const color = colorNamed(colorOfRgb(path.color_rgb));
      this.ribbons.set(i, triples(path.points, 0.06 + 0.02 * i), 0.05 + 0.22 * p, () => color,
        (share) => (0.15 + 0.85 * p) * (1 - 0.4 * share));
    }
  }

  private drawPlan({ points, tail }: Plan): void {
    const path = triples(points);
    const isTail = (i: number): boolean => i / (path.length - 1) > tail;
    this.ribbons.set(maxPaths, path, 0.09, (i) => (isTail(i) ? tailColor : planColor),
      (share) => (share > tail ? 0.45 : 0.95));
  }

  private drawDetails(now_s: number, vehicle: SeenVehicle,
                      fresh: (heard?: { time_s: number }) => boolean): void {
    const { "target/intention": intention, "plan/trajectory": plan, "target/state": target,
      "safety/state": safety } = vehicle.latest;
    if (safety && this.isNew(safety)) this.bounds.set(safety.message);
    this.sectors.mesh.visible = fresh(intention) && target?.message.status !== Track.lost;
    const division = vehicle.latest["fleet/division"];
    this.seats.mesh.visible = fresh(division) && target !== undefined;
    if (division && target && this.isNew(division)) this.drawSeats(division.message, target.message);
    this.regions.mesh.visible = fresh(plan);
    this.corridor.mesh.visible = fresh(plan);
    if (intention && this.isNew(intention)) this.drawSectors(intention.message);
    if (!plan || Math.abs(now_s - this.corridor_s) < corridorPeriod_s) return;
    this.corridor_s = now_s;
    this.regions.set(plan.message.regions.map((region): Fan => ({
      center: [region.target_position_m[0]!, region.target_position_m[1]!, 0.03],
      radius_m: reach_m, bisector_rad: region.bisector_yaw_rad, half_rad: region.half_angle_rad,
      color: blue, alpha: 0.9 / Math.max(4, plan.message.regions.length),
    })));
    this.corridor.set(plan.message.corridor.flatMap(({ faces }) =>
      polytopeEdges(faces.slice(0, 40))));
  }

  // Each in its vehicle's colour, round where the person is now.
  private drawSeats(seats: readonly Seat[], target: Sketches["target/state"]): void {
    this.seats.set(seats.slice(0, maxSeats).map(({ vehicle, bearing_rad, near }): Fan => ({
      center: [target.x, target.y, 0.035], radius_m: ring_m[near ? 0 : 1], bisector_rad: bearing_rad,
      half_rad: Math.PI / 12, color: colorOf(Number(/(\d+)$/.exec(vehicle)?.[1] ?? 1) - 1), alpha: 0.35,
    })));
  }

  private drawSectors({ region_now, region_ahead }: Sketches["target/intention"]): void {
    this.sectors.set([region_now, region_ahead].flatMap((region, i): Fan[] => {
      const center: Point = [region.center_m[0]!, region.center_m[1]!, 0.045];
      const common = { center, radius_m: region.radius_m, alpha: i === 0 ? 0.5 : 0.25 };
      return [
        { ...common, bisector_rad: region.left_bisector_yaw_rad,
          half_rad: region.left_half_angle_rad, color: orange },
        { ...common, bisector_rad: region.right_bisector_yaw_rad,
          half_rad: region.right_half_angle_rad, color: green },
      ];
    }));
  }
}
