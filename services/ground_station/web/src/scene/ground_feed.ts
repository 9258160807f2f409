// SPDX-License-Identifier: Apache-2.0
// Fetches the map around the chosen vehicle for the scene, anew when it has gone far.
import { type Piece, piecesOf } from "../ground/ground_map.ts";
import { type Metres, originOf } from "../ground/place.ts";
import type { Session } from "../ui/session.ts";
import type { GroundPiece } from "./ground.ts";

const reach_m = 110;
const far_m = 40;
const fine_px_per_m = 4;

export class GroundFeed {
  private middle: Metres | null = null;
  private shown = ""; // what was asked for last

  constructor(private readonly session: Session, private readonly give: (pieces: GroundPiece[]) => void) {}

  /** Now and then. */
  look(): void {
    const { vehicle, ground } = this.session;
    const position = vehicle?.latest["odometry"]?.message.pose.pose.position;
    if (!ground || !position) return;
    const here: Metres = [position.x, position.y];
    if (!this.middle || Math.hypot(here[0] - this.middle[0], here[1] - this.middle[1]) > far_m)
      this.middle = here;
    const [x, y] = this.middle;
    const area = { west: x - reach_m, east: x + reach_m, south: y - reach_m, north: y + reach_m };
    const pieces = piecesOf(ground, originOf(vehicle), area, fine_px_per_m);
    const wanted = JSON.stringify(pieces);
    if (wanted === this.shown) return;
    this.shown = wanted;
    void this.fetchAll(pieces, wanted);
  }

  // A tile that is not there leaves the ground bare.
  private async fetchAll(pieces: Piece[], wanted: string): Promise<void> {
    const { operator } = this.session;
    const found = await Promise.all(pieces.map(async ({ path, corners }) => {
      const answer = await fetch(path, { headers: operator.headers() }).catch(() => null);
      if (!answer?.ok) return null;
      const bitmap = await createImageBitmap(await answer.blob()).catch(() => null);
      return bitmap && { bitmap, corners };
    }));
    if (wanted === this.shown) this.give(found.filter((piece) => piece !== null));
  }
}
