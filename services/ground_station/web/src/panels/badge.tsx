// SPDX-License-Identifier: Apache-2.0
// Words with a colour and a sign, so that neither has to be told apart alone.
import type { ComponentChildren } from "preact";

import type { Severity } from "../store/state.ts";
import { t } from "../ui/words.ts";

export type Mood = "good" | "info" | "warning" | "alarm" | "quiet";

const signs: Record<Mood, string> = { good: "●", info: "●", warning: "▲", alarm: "■", quiet: "○" };

export function Badge({ mood, children }: { mood: Mood; children: ComponentChildren }) {
  return <span class={`badge ${mood}`}><i aria-hidden>{signs[mood]}</i> {children}</span>;
}

export function SeveritySign({ severity }: { severity: Severity }) {
  return <span class={`sign ${severity}`} title={severity}>{signs[severity]}</span>;
}

/** Dims what is old, and then says how old it is. */
export function Aged({ age_s, limit_s, children }:
    { age_s: number; limit_s: number; children: ComponentChildren }) {
  const stale = age_s < 0 || age_s > limit_s;
  if (!stale) return <span class="aged">{children}</span>;
  const text = age_s < 0 ? t("never")
    : t("{age} old", { age: `${age_s < 10 ? age_s.toFixed(1) : age_s.toFixed(0)} s` });
  return <span class="aged stale">{children} <em class="age">{text}</em></span>;
}
