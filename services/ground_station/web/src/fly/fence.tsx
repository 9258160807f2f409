// SPDX-License-Identifier: Apache-2.0
// A fence and a band of altitudes: drawn, checked, sent.
import type { Bounds } from "../store/derive.ts";
import { order } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { type Corner, faultOf, type FenceFault, most_corners } from "./fence.ts";

export const noBounds: Bounds = { fence_m: [], altitude_min_m: null, altitude_max_m: null };

function faultText(fault: FenceFault): string {
  if (fault === "few") return t("a fence has three corners at least");
  if (fault === "many") return t("a fence has {most} corners at most", { most: most_corners });
  if (fault === "crossed") return t("its sides cross");
  return fault === "outside" ? t("the vehicle is outside of it") : "";
}

/** What is wrong with these bounds; "": nothing. */
export function problemOf(bounds: Bounds, here: Corner | null): string {
  const { altitude_min_m: low, altitude_max_m: high } = bounds;
  const crossed = low !== null && high !== null && low >= high;
  return faultText(faultOf(bounds.fence_m, here)) ||
    (crossed ? t("the lower altitude is above the upper") : "");
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

interface Props { session: Session; bounds: Bounds; draft: Bounds | null; why: string;
  problem: string; setDraft(draft: Bounds | null): void }

export function FencePart({ session, bounds, draft, why, problem, setDraft }: Props) {
  const editable = why === "";
  const change = (part: Partial<Bounds>): void => setDraft({ ...bounds, ...part });
  const send = async (): Promise<void> => {
    if (await order(session, session.commanded, "bounds", { ...bounds })) setDraft(null);
  };
  return (
    <>
      <div class="row">
        <Altitude label={t("from")} value={bounds.altitude_min_m} disabled={!editable}
          set={(altitude_min_m) => change({ altitude_min_m })} />
        <Altitude label={t("to")} value={bounds.altitude_max_m} disabled={!editable}
          set={(altitude_max_m) => change({ altitude_max_m })} />
        <small>{t("over the ground below")}</small>
      </div>
      <div class="row">
        <button disabled={!editable || !draft || problem !== ""} title={why || problem}
          onClick={() => void send()}>{t("Send fence")}</button>
        <button disabled={!editable || bounds.fence_m.length === 0}
          onClick={() => change({ fence_m: bounds.fence_m.slice(0, -1) })}>
          {t("Undo corner")}</button>
        <button disabled={!editable} onClick={() => setDraft(noBounds)}>{t("Clear")}</button>
        {draft ? <button onClick={() => setDraft(null)}>{t("Discard")}</button> : null}
      </div>
    </>
  );
}
