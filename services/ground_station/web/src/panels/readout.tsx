// SPDX-License-Identifier: Apache-2.0
// The chosen vehicle in words, over the scene: as the terminal view says it.
import type { SafetyState } from "../data/messages.ts";
import { choiceOf, choiceText } from "../picture/choice.tsx";
import { Choice, explainGate, explainPlan, modeWord, planWord, PlanState, searchWord, trackWord, Track,
} from "../data/words.ts";
import { band_m, distance_m, yawError_rad } from "../store/derive.ts";
import { age_s } from "../store/state.ts";
import { stale_s } from "../store/watch.ts";
import { number } from "../ui/format.ts";
import { colorOfRgb, spoken } from "../ui/palette.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { Aged } from "./badge.tsx";
import { FleetRow } from "./fleet.tsx";

/** Why the autopilot would refuse offboard mode, which the gate adds to its text. */
function hindranceOf(safety: SafetyState): string {
  return /would refuse: (.*)$/.exec(safety.text ?? "")?.[1] ?? "";
}

export function Readout({ session }: { session: Session }) {
  const { state, vehicle } = session;
  if (!vehicle) return null;
  const { latest } = vehicle;
  const target = latest["target/state"];
  const odometry = latest["odometry"]?.message;
  const intention = latest["target/intention"];
  const plan = latest["plan/trajectory"];
  const safety = latest["safety/state"];
  const search = latest["target/search"];
  const choice = choiceOf(session);
  const error = yawError_rad(odometry, target?.message);
  const error_deg = error === null ? null : (error * 180) / Math.PI;
  const gap_m = distance_m(odometry, target?.message);
  const band = band_m(state, vehicle);
  const inBand = gap_m !== null && (!band || (gap_m >= band[0] && gap_m <= band[1]));
  const sum_ms = plan?.message.stage_times.filter((s) => s.stage !== "total")
    .reduce((sum, s) => sum + s.ms, 0);
  return (
    <dl class="readout" aria-label={t("readout")}>
      <dt>{t("person")}</dt>
      <dd><Aged age_s={age_s(state, target)} limit_s={stale_s}>
        <span data-field="person">{trackWord(target?.message.status ?? Track.none)}</span>{" "}
        <span data-field="distance" class={inBand ? "" : "off"}>{number(gap_m, 2, "m")}</span>{" "}
        <span data-field="bearing">{t("{degrees}° off", { degrees: number(error_deg, 0) })}</span>
      </Aged></dd>
      {choice && <>
        <dt>{t("choice")}</dt>
        <dd class={choice.state === Choice.doubtful ? "off" : ""} data-field="choice">
          {choiceText(choice)}</dd>
      </>}
      <dt>{t("intention")}</dt>
      <dd><Aged age_s={age_s(state, intention)} limit_s={stale_s}>
        <span class="odds">{intention?.message.intentions.map((i) => (
          <span key={i.name} class="odd" title={`${i.name} ${i.probability.toFixed(2)}`}
            data-field={`p-${i.name}`} data-value={i.probability.toFixed(3)}>
            <i style={{ background: colorOfRgb(i.color_rgb),
              width: `${Math.round(100 * i.probability)}%` }} />
            <em>{spoken(i.name)} {i.probability.toFixed(2)}</em>
          </span>
        ))}</span>
      </Aged></dd>
      <dt>{t("plan")}</dt>
      <dd><Aged age_s={age_s(state, plan)} limit_s={stale_s}>
        <span data-field="plan">{planWord(plan?.message.status ?? PlanState.none)}</span>{" "}
        {plan && plan.message.reason > 0 ? `(${explainPlan(plan.message.reason)}) ` : ""}
        {number(sum_ms, 1, "ms")}
      </Aged></dd>
      {search && search.message.mode > 0 && <>
        <dt>{t("search")}</dt>
        <dd><Aged age_s={age_s(state, search)} limit_s={stale_s}>
          <span data-field="search">{searchWord(search.message.mode)}</span>{" "}
          {t("unseen for {time}, up to {speed}", { time: number(search.message.unseen_s, 0, "s"),
            speed: number(search.message.speed_max_mps, 1, "m/s") })}
        </Aged></dd>
      </>}
      <dt>{t("gate")}</dt>
      <dd><Aged age_s={age_s(state, safety)} limit_s={stale_s}>
        <span data-field="gate">{safety ? modeWord(safety.message.mode) : "–"}</span>
        {safety && safety.message.reason > 0 ? `: ${explainGate(safety.message.reason)}` : ""}
        {safety && hindranceOf(safety.message) ? ` (${hindranceOf(safety.message)})` : ""}
      </Aged></dd>
      <FleetRow session={session} />
    </dl>
  );
}
