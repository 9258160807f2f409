// SPDX-License-Identifier: Apache-2.0
// What the scene knows of the page's state: the sum of all news.
import { Trail } from "../store/series.ts";
import type { News } from "./messages.ts";
import type { Seen } from "./sketch.ts";

export interface SeenVehicle {
  name: string;
  index: number;
  latest: Seen;
  trail: Trail;
  targetTrail: Trail;
}

export class Known {
  now_s = 0;
  chosen = "";
  generation = -1;
  readonly vehicles = new Map<string, SeenVehicle>();

  apply({ generation, now_s, chosen, vehicles }: News): void {
    if (generation !== this.generation) this.vehicles.clear();
    Object.assign(this, { generation, now_s, chosen });
    for (const { name, index, latest, trail, targetTrail } of vehicles) {
      let vehicle = this.vehicles.get(name);
      if (!vehicle) {
        vehicle = { name, index, latest: {}, trail: new Trail(), targetTrail: new Trail() };
        this.vehicles.set(name, vehicle);
      }
      Object.assign(vehicle.latest, latest);
      for (const { time_s, x, y, z } of trail) vehicle.trail.push(time_s, x, y, z);
      for (const { time_s, x, y, z } of targetTrail) vehicle.targetTrail.push(time_s, x, y, z);
    }
  }
}
