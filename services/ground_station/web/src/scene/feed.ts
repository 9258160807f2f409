// SPDX-License-Identifier: Apache-2.0
// What the scene has not been told yet of the state that the page shows.
import type { TrailPoint } from "../store/series.ts";
import type { Latest, State, Vehicle } from "../store/state.ts";
import type { News, VehicleNews } from "./messages.ts";
import { drawnTopics, moreOfChosen, type Seen, sketch } from "./sketch.ts";

interface Told { chosen: boolean; latest: Partial<Latest>; trail_s: number; targetTrail_s: number }

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
    const vehicles = [...state.vehicles.values()].map((vehicle) =>
      this.newsOf(vehicle, vehicle === chosen));
    return { generation, now_s: state.now_s, chosen: chosen?.name ?? "", vehicles };
  }

  private newsOf(vehicle: Vehicle, chosen: boolean): VehicleNews {
    const { name, index } = vehicle;
    const told = this.told.get(name)
      ?? { chosen, latest: {}, trail_s: -Infinity, targetTrail_s: -Infinity };
    this.told.set(name, told);
    if (chosen !== told.chosen) for (const topic of moreOfChosen) delete told.latest[topic];
    told.chosen = chosen;
    const latest: Seen = {};
    for (const topic of drawnTopics) {
      const heard = vehicle.latest[topic];
      if (!heard || heard === told.latest[topic]) continue;
      Object.assign(told.latest, { [topic]: heard });
      Object.assign(latest, { [topic]: sketch(topic, heard, chosen) });
    }
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
