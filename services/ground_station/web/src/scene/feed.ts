// What the scene has not been told yet of the state that the page shows.
import type { TrailPoint } from "../store/series.ts";
import type { Latest, State, Vehicle } from "../store/state.ts";
import { drawnTopics, type News, type VehicleNews } from "./messages.ts";

interface Told { latest: Partial<Latest>; trail_s: number; targetTrail_s: number }

interface Shown {
  readonly state: State;
  readonly vehicle: Vehicle | undefined; // the chosen one
  readonly generation: number;
}

export class SceneFeed {
  private readonly told = new Map<string, Told>();
  private generation = -1;

  take({ state, vehicle: chosen, generation }: Shown): News {
    if (generation !== this.generation) this.told.clear();
    this.generation = generation;
    const vehicles = [...state.vehicles.values()].map((vehicle) => this.newsOf(vehicle));
    return { generation, now_s: state.now_s, chosen: chosen?.name ?? "", vehicles };
  }

  private newsOf(vehicle: Vehicle): VehicleNews {
    const { name, index } = vehicle;
    let told = this.told.get(name);
    if (!told) this.told.set(name, told = { latest: {}, trail_s: -Infinity, targetTrail_s: -Infinity });
    const latest: Partial<Latest> = {};
    for (const topic of drawnTopics)
      if (vehicle.latest[topic] !== told.latest[topic])
        Object.assign(latest, { [topic]: vehicle.latest[topic] });
    Object.assign(told.latest, latest);
    const trail = since(vehicle.trail.points, told.trail_s);
    const targetTrail = since(vehicle.targetTrail.points, told.targetTrail_s);
    told.trail_s = trail.at(-1)?.time_s ?? told.trail_s;
    told.targetTrail_s = targetTrail.at(-1)?.time_s ?? told.targetTrail_s;
    return { name, index, latest, trail, targetTrail };
  }
}

function since(points: TrailPoint[], time_s: number): TrailPoint[] {
  let from = points.length;
  while (from > 0 && points[from - 1]!.time_s > time_s) from--;
  return points.slice(from);
}
