// SPDX-License-Identifier: Apache-2.0
// A map with north up: where everybody is and was, the fence and the return place, which can be
// drawn on it.
import { useRef, useState } from "preact/hooks";

import { query } from "../data/token.ts";
import { originOf } from "../ground/place.ts";
import type { Vehicle } from "../store/state.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Background, Coordinates } from "./background.tsx";
import { type Corner, type Map2d, mapAround, most_corners, scaleOf, toMetres, toPixel, zoomed,
} from "./fence.ts";

export const [width, height] = [360, 260];

export interface Drawing { fence: Corner[]; home: Corner | null }

interface MapProps {
  session: Session;
  vehicle: Vehicle | undefined;
  drawing: Drawing;
  draws: "fence" | "home" | "nothing"; // what a click sets
  change(part: Partial<Drawing>): void;
}

const steps: Record<string, Corner> = { ArrowLeft: [-0.5, 0], ArrowRight: [0.5, 0],
  ArrowUp: [0, 0.5], ArrowDown: [0, -0.5] };

const pathOf = (map: Map2d, points: Corner[]): string =>
  points.map((p, i) => `${i ? "L" : "M"}${toPixel(map, p).map((v) => v.toFixed(1)).join(" ")}`)
    .join("");

export function hereOf(vehicle: Vehicle | undefined): Corner | null {
  const position = vehicle?.latest["odometry"]?.message.pose.pose.position;
  return position ? [position.x, position.y] : null;
}

/** What moved and what is set; nothing of it can be held. */
function Known({ map, vehicle, drawing }: { map: Map2d; vehicle: Vehicle | undefined; drawing: Drawing }) {
  const trail = vehicle?.trail.points.map((p): Corner => [p.x, p.y]) ?? [];
  const person = vehicle?.targetTrail.points.map((p): Corner => [p.x, p.y]) ?? [];
  const here = hereOf(vehicle);
  const [x, y] = here ? toPixel(map, here) : [0, 0];
  const [homeX, homeY] = drawing.home ? toPixel(map, drawing.home) : [0, 0];
  return (
    <>
      <path d={pathOf(map, person)} class="person" /><path d={pathOf(map, trail)} class="trail" />
      {drawing.fence.length > 0 ? <path d={`${pathOf(map, drawing.fence)}Z`} class="fence" /> : null}
      {here ? <circle class="here" cx={x} cy={y} r="5" /> : null}
      {drawing.home ? (
        <g class="home" transform={`translate(${homeX} ${homeY})`}>
          <circle r="8" /><text y="4" text-anchor="middle">{t("H")}</text></g>
      ) : null}
    </>
  );
}

interface CornersProps { map: Map2d; fence: Corner[]; editable: boolean;
  hold(event: PointerEvent, i: number): void; change(fence: Corner[]): void }

function Corners({ map, fence, editable, hold, change }: CornersProps) {
  const key = (event: KeyboardEvent, i: number): void => {
    const step = steps[event.key];
    if (!editable || (!step && event.key !== "Delete")) return;
    event.preventDefault();
    event.stopPropagation();
    if (!step) return change(fence.filter((_, k) => k !== i));
    change(fence.map((c, k): Corner => (k === i ? [c[0] + step[0], c[1] + step[1]] : c)));
  };
  return <>{fence.map((corner, i) => {
    const [x, y] = toPixel(map, corner);
    return (
      <circle key={i} class="corner" cx={x} cy={y} r="7" tabIndex={editable ? 0 : -1} role="button"
        aria-label={t("corner {n}", { n: i + 1 })} onPointerDown={(event) => hold(event, i)}
        onKeyDown={(event) => key(event, i)} />
    );
  })}</>;
}

function Ruler({ map }: { map: Map2d }) {
  const { metres, px } = scaleOf(map);
  return (
    <>
      <path class="ruler" d={`M10 ${height - 12}h${px}`} />
      <text x="10" y={height - 17}>{metres} m</text>
      <text x={width - 22} y="18">{t("N")} ↑</text>
    </>
  );
}

/** While something is held, the map stands still. */
function useMap(vehicle: Vehicle | undefined, drawing: Drawing, held: boolean, zoom: number): Map2d {
  const kept = useRef<Map2d | null>(null);
  if (held && kept.current) return kept.current;
  const points = [...vehicle?.trail.points ?? [], ...vehicle?.targetTrail.points ?? []]
    .map((p): Corner => [p.x, p.y]);
  const more = [hereOf(vehicle), drawing.home].filter((p) => p !== null);
  kept.current = zoomed(mapAround([...points, ...drawing.fence, ...more], width, height), zoom,
    width, height);
  return kept.current;
}

export function FlightMap({ session, vehicle, drawing, draws, change }: MapProps) {
  const svg = useRef<SVGSVGElement>(null);
  const held = useRef<number | null>(null); // a corner
  const [zoom, setZoom] = useState(1);
  const map = useMap(vehicle, drawing, held.current !== null, zoom);
  const [pointed, setPointed] = useState<Corner | null>(null);
  const { fence } = drawing;
  const origin = originOf(vehicle);
  const at = (event: PointerEvent): Corner => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY)
      .matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return toMetres(map, [x, y]);
  };
  const hold = (event: PointerEvent, i: number): void => {
    if (draws !== "fence") return;
    event.stopPropagation();
    held.current = i;
    svg.current!.setPointerCapture(event.pointerId);
  };
  const press = (event: PointerEvent): void => {
    if (draws === "home") change({ home: at(event) });
    if (draws !== "fence" || held.current !== null || fence.length >= most_corners) return;
    hold(event, fence.length);
    change({ fence: [...fence, at(event)] });
  };
  const move = (event: PointerEvent): void => {
    setPointed(at(event));
    if (held.current === null) return;
    change({ fence: fence.map((c, k) => (k === held.current ? at(event) : c)) });
  };
  return (
    <div class="flightmap">
      <svg ref={svg} class="fencemap" viewBox={`0 0 ${width} ${height}`} role="img"
        aria-label={t("map with the fence, north up")} onPointerDown={press} onPointerMove={move}
        onPointerUp={() => (held.current = null)} onPointerCancel={() => (held.current = null)}
        onPointerLeave={() => setPointed(null)}>
        <Background map={map} ground={session.ground} origin={origin} width={width} height={height}
          query={query()} />
        <Known map={map} vehicle={vehicle} drawing={drawing} />
        <Corners map={map} fence={fence} editable={draws === "fence"} hold={hold}
          change={(moved) => change({ fence: moved })} />
        <Ruler map={map} />
      </svg>
      <Coordinates origin={origin} pointed={pointed} here={hereOf(vehicle)} />
      <nav class="zoom" aria-label={t("map")}>
        <button aria-label={t("closer")} title={t("closer")} onClick={() => setZoom(zoom * 1.5)}>+</button>
        <button aria-label={t("farther")} title={t("farther")} onClick={() => setZoom(zoom / 1.5)}>−</button>
      </nav>
    </div>
  );
}
