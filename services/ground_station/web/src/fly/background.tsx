// SPDX-License-Identifier: Apache-2.0
// The station's map under what is drawn, and where on the Earth that is.
import { type GroundMap, piecesOf } from "../ground/ground_map.ts";
import { placeText, toWgs84, type Wgs84 } from "../ground/place.ts";
import { t } from "../ui/words.ts";
import { type Corner, type Map2d, toMetres, toPixel } from "./fence.ts";

interface BackgroundProps { map: Map2d; ground: GroundMap | null; origin: Wgs84 | null; query: string;
  width: number; height: number }

export function Background({ map, ground, origin, query, width, height }: BackgroundProps) {
  if (!ground) return null;
  const [[west, north], [east, south]] = [toMetres(map, [0, 0]), toMetres(map, [width, height])];
  const pieces = piecesOf(ground, origin, { west, south, east, north }, map.scale);
  return <>{pieces.map(({ path, corners }) => {
    const [[x, y], [rx, ry], [lx, ly]] = corners.map((corner) => toPixel(map, corner)) as
      [Corner, Corner, Corner];
    return (
      <image key={path} href={path + query} width="1" height="1" preserveAspectRatio="none"
        transform={`matrix(${rx - x} ${ry - y} ${lx - x} ${ly - y} ${x} ${y})`} />
    );
  })}</>;
}

/** Of the vehicle, or of where the map is pointed at. */
export function Coordinates({ origin, pointed, here }:
    { origin: Wgs84 | null; pointed: Corner | null; here: Corner | null }) {
  const at = pointed ?? here;
  if (!at) return null;
  const metres = t("{east} m east, {north} m north", { east: at[0].toFixed(1), north: at[1].toFixed(1) });
  return (
    <output class="coordinates" data-field="coordinates">
      {pointed ? "⌖" : "●"} {metres}{origin ? ` · ${placeText(toWgs84(origin, at))}` : ""}</output>
  );
}
