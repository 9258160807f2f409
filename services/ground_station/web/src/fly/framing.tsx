// SPDX-License-Identifier: Apache-2.0
// Distance, height, side and circling by sliders, under the lease.
import { useState } from "preact/hooks";

import { obstacle } from "../panels/commands.tsx";
import { order } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { type Framing, framingOf, framingText, free, limitsOf, presets, same, sideOf, sides,
} from "./framing.ts";

interface SliderProps {
  label: string;
  unit: string;
  range: readonly [number, number];
  step: number;
  digits: number;
  value: number | null; // null: free
  start: number; // where it stands when it is set for the first time
  disabled: boolean;
  scale?: number; // of what is shown to what is set
  slide(value: number): void;
  set(value: number | null): void;
}

function Slider(props: SliderProps) {
  const { label, unit, range, step, digits, value, start, disabled, scale = 1, slide, set } = props;
  const [low, high] = range;
  const shown = (value ?? start) * scale;
  const at = (event: { currentTarget: HTMLInputElement }): number =>
    Number(event.currentTarget.value) / scale;
  return (
    <div class="slider">
      <label><input type="checkbox" checked={value !== null} disabled={disabled}
        onChange={(event) => set(event.currentTarget.checked ? start : null)} /> {label}</label>
      <input type="range" aria-label={label} min={low * scale} max={high * scale} step={step}
        value={shown} disabled={disabled || value === null}
        aria-valuetext={`${shown.toFixed(digits)} ${unit}`}
        onInput={(event) => slide(at(event))} onChange={(event) => set(at(event))} />
      <output>{value === null ? t("free") : `${shown.toFixed(digits)} ${unit}`}</output>
    </div>
  );
}

function Side({ value, disabled, set }:
    { value: number | null; disabled: boolean; set(bearing: number | null): void }) {
  const side = sideOf(value);
  return (
    <div class="sides" role="radiogroup" aria-label={t("side")}>
      <span>{t("side")}</span>
      {sides.map(([name, bearing]) => (
        <button key={name} role="radio" aria-checked={side === name} aria-pressed={side === name}
          disabled={disabled} onClick={() => set(bearing)}>{t(name)}</button>
      ))}
    </div>
  );
}

export function FramingPanel({ session }: { session: Session }) {
  const [draft, setDraft] = useState<Framing | null>(null); // while it is moved, or not answered
  const why = session.replay ? t("a recording is shown") : obstacle(session);
  const state = session.liveState.vehicles.get(session.commanded);
  const limits = limitsOf(session.liveState, state);
  const message = state?.latest["safety/state"]?.message.framing;
  const isSet = message ? framingOf(message) : null;
  const shown = draft ?? isSet ?? free;
  const send = async (framing: Framing): Promise<void> => {
    setDraft(framing);
    await order(session, session.commanded, "framing", framing);
    setTimeout(() => setDraft(null), 1200); // then what the gate says is shown again
  };
  const disabled = why !== "";
  const radps_deg = 180 / Math.PI;
  return (
    <section class="framing" aria-label={t("framing")}>
      <h2>{t("Framing")}</h2>
      <p class="set" data-field="framing">{t("set:")}{" "}
        {isSet ? framingText(isSet) : t("not known")}
        {draft && isSet && !same(draft, isSet) ? <em> → {framingText(draft)}</em> : null}</p>
      <Slider label={t("distance")} unit="m" range={limits.distance_m} step={0.1} digits={1}
        value={shown.distance_m} start={2.5} disabled={disabled}
        slide={(distance_m) => setDraft({ ...shown, distance_m })}
        set={(distance_m) => void send({ ...shown, distance_m })} />
      <Slider label={t("height")} unit="m" range={limits.height_m} step={0.1} digits={1}
        value={shown.height_m} start={0.5} disabled={disabled}
        slide={(height_m) => setDraft({ ...shown, height_m })}
        set={(height_m) => void send({ ...shown, height_m })} />
      <Slider label={t("circling")} unit="°/s" range={limits.circling_radps} step={1} digits={0}
        scale={radps_deg} value={shown.circling_radps === 0 ? null : shown.circling_radps}
        start={0.2} disabled={disabled}
        slide={(circling_radps) => setDraft({ ...shown, circling_radps })}
        set={(value) => void send({ ...shown, circling_radps: value ?? 0 })} />
      <Side value={shown.bearing_rad} disabled={disabled}
        set={(bearing_rad) => void send({ ...shown, bearing_rad })} />
      <div class="presets" aria-label={t("presets")}>
        {presets.map(([name, framing]) => (
          <button key={name} disabled={disabled} title={why}
            aria-pressed={isSet !== null && same(framing, isSet)}
            onClick={() => void send(framing)}>{t(name)}</button>
        ))}
      </div>
      {why ? <p class="why">{why}</p> : null}
    </section>
  );
}
