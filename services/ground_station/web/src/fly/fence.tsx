// SPDX-License-Identifier: Apache-2.0
// Where it may fly: a fence drawn on a map with north up, and a band of altitudes.
import { useRef, useState } from "preact/hooks";

import { obstacle } from "../panels/commands.tsx";
import type { Bounds, Vehicle } from "../store/state.ts";
import type { Session } from "../ui/session.ts";
import { order } from "../ui/orders.ts";
import { t } from "../ui/words.ts";
import { type Corner, faultOf, type FenceFault, type Map2d, mapAround, most_corners, toMetres,
  toPixel } from "./fence.ts";

const [width, height] = [360, 260];
const noBounds: Bounds = { fence_m: [], altitude_min_m: null, altitude_max_m: null };

const pathOf = (map: Map2d, points: Corner[]): string =>
  points.map((p, i) => `${i ? "L" : "M"}${toPixel(map, p).map((v) => v.toFixed(1)).join(" ")}`)
    .join("");

function faultText(fault: FenceFault): string {
  if (fault === "few") return t("a fence has three corners at least");
  if (fault === "many") return t("a fence has {most} corners at most", { most: most_corners });
  if (fault === "crossed") return t("its sides cross");
  return fault === "outside" ? t("the vehicle is outside of it") : "";
}

function scaleOf(map: Map2d): { metres: number; px: number } {
  const metres = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]
    .find((m) => m * map.scale > 40) ?? 1000;
  return { metres, px: metres * map.scale };
}

interface MapProps {
  vehicle: Vehicle | undefined;
  fence: Corner[];
  editable: boolean;
  change(fence: Corner[]): void;
}

function FenceMap({ vehicle, fence, editable, change }: MapProps) {
  const svg = useRef<SVGSVGElement>(null);
  const held = useRef<number | null>(null);
  const kept = useRef<Map2d | null>(null); // while a corner is held the map stands still
  const trail = vehicle?.trail.points.map((p): Corner => [p.x, p.y]) ?? [];
  const person = vehicle?.targetTrail.points.map((p): Corner => [p.x, p.y]) ?? [];
  const position = vehicle?.latest["odometry"]?.message.pose.pose.position;
  const here: Corner | null = position ? [position.x, position.y] : null;
  if (held.current === null || !kept.current)
    kept.current = mapAround([...trail, ...person, ...fence, ...(here ? [here] : [])], width, height);
  const map = kept.current;
  const at = (event: PointerEvent): Corner => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY)
      .matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return toMetres(map, [x, y]);
  };
  const put = (i: number, corner: Corner): void => change(fence.map((c, k) => (k === i ? corner : c)));
  const { metres, px } = scaleOf(map);
  return (
    <svg ref={svg} class="fencemap" viewBox={`0 0 ${width} ${height}`} role="img"
      aria-label={t("map with the fence, north up")}
      onPointerDown={(event) => {
        if (!editable || held.current !== null || fence.length >= most_corners) return;
        held.current = fence.length;
        svg.current!.setPointerCapture(event.pointerId);
        change([...fence, at(event)]);
      }}
      onPointerMove={(event) => {
        if (held.current !== null) put(held.current, at(event));
      }}
      onPointerUp={() => (held.current = null)} onPointerCancel={() => (held.current = null)}>
      <path d={pathOf(map, person)} class="person" /><path d={pathOf(map, trail)} class="trail" />
      {fence.length > 0 ? <path d={`${pathOf(map, fence)}Z`} class="fence" /> : null}
      {here ? <circle class="here" cx={toPixel(map, here)[0]} cy={toPixel(map, here)[1]} r="5" /> : null}
      {fence.map((corner, i) => {
        const [x, y] = toPixel(map, corner);
        return (
          <circle key={i} class="corner" cx={x} cy={y} r="7" tabIndex={editable ? 0 : -1}
            role="button" aria-label={t("corner {n}", { n: i + 1 })}
            onPointerDown={(event) => {
              if (!editable) return;
              event.stopPropagation();
              held.current = i;
              svg.current!.setPointerCapture(event.pointerId);
            }}
            onKeyDown={(event) => {
              const steps: Record<string, Corner> = { ArrowLeft: [-0.5, 0], ArrowRight: [0.5, 0],
                ArrowUp: [0, 0.5], ArrowDown: [0, -0.5] };
              const step = steps[event.key];
              if (!editable || (!step && event.key !== "Delete")) return;
              event.preventDefault();
              event.stopPropagation();
              if (step) put(i, [corner[0] + step[0], corner[1] + step[1]]);
              else change(fence.filter((_, k) => k !== i));
            }} />
        );
      })}
      <path class="ruler" d={`M10 ${height - 12}h${px}`} />
      <text x="10" y={height - 17}>{metres} m</text>
      <text x={width - 22} y="18">{t("N")} ↑</text>
    </svg>
  );
}

function Altitude({ label, value, set, disabled }:
    { label: string; value: number | null; set(value: number | null): void; disabled: boolean }) {
  return (
    <label>{label} <input type="number" step="0.5" min="0" max="500" disabled={disabled}
      value={value ?? ""} placeholder="–" onInput={(event) => {
        const { value: text } = event.currentTarget;
        set(text === "" ? null : Number(text));
      }} /> m</label>
  );
}

export function FencePanel({ session }: { session: Session }) {
  const [draft, setDraft] = useState<Bounds | null>(null);
  const vehicle = session.replay ? session.vehicle
    : session.liveState.vehicles.get(session.commanded);
  const why = session.replay ? t("a recording is shown") : obstacle(session);
  const bounds = draft ?? vehicle?.bounds ?? noBounds;
  const position = vehicle?.latest["odometry"]?.message.pose.pose.position;
  const fault = faultOf(bounds.fence_m, position ? [position.x, position.y] : null);
  const { altitude_min_m: low, altitude_max_m: high } = bounds;
  const crossed = low !== null && high !== null && low >= high;
  const editable = why === "";
  const change = (part: Partial<Bounds>): void => setDraft({ ...bounds, ...part });
  const send = async (sent: Bounds): Promise<void> => {
    if (await order(session, session.commanded, "bounds", { ...sent })) setDraft(null);
  };
  const problem = faultText(fault) || (crossed ? t("the lower altitude is above the upper") : "");
  return (
    <section class="bounds" aria-label={t("fence")}>
      <h2>{t("Fence")} <small>{draft ? t("drawn, not sent yet")
        : vehicle?.bounds ? t("as it is set") : t("not known since this page was opened")}</small></h2>
      <FenceMap vehicle={vehicle} fence={bounds.fence_m} editable={editable}
        change={(fence_m) => change({ fence_m })} />
      <div class="row">
        <Altitude label={t("from")} value={low} disabled={!editable}
          set={(altitude_min_m) => change({ altitude_min_m })} />
        <Altitude label={t("to")} value={high} disabled={!editable}
          set={(altitude_max_m) => change({ altitude_max_m })} />
        <small>{t("over the ground below")}</small>
      </div>
      <div class="row">
        <button disabled={!editable || !draft || problem !== ""} title={why || problem}
          onClick={() => void send(bounds)}>{t("Send fence")}</button>
        <button disabled={!editable || bounds.fence_m.length === 0}
          onClick={() => change({ fence_m: bounds.fence_m.slice(0, -1) })}>
          {t("Undo corner")}</button>
        <button disabled={!editable} onClick={() => setDraft(noBounds)}>{t("Clear")}</button>
        {draft ? <button onClick={() => setDraft(null)}>{t("Discard")}</button> : null}
      </div>
      <p class="why">{why || problem || (editable ? t("Click the map to add corners; drag to move " +
        "them; Delete takes one away.") : "")}</p>
    </section>
  );
}
