// SPDX-License-Identifier: Apache-2.0
// STOP: held for a moment, on every screen, for the vehicle whose name it bears.
import type { RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import { order } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";

export const hold_ms = 600;

interface HoldProps { label: string; act(): void; press?: RefObject<(pressed: boolean) => void>;
  disabled?: boolean; hint?: string; calm?: boolean /* is no emergency */ }

export function HoldButton({ label, act, press, disabled, hint, calm }: HoldProps) {
  const [holding, setHolding] = useState(false);
  const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  const acting = useRef(act);
  acting.current = act;
  const set = (pressed: boolean): void => {
    clearTimeout(timer.current);
    setHolding(pressed);
    if (!pressed) return;
    timer.current = setTimeout(() => {
      setHolding(false);
      acting.current();
    }, hold_ms);
  };
  if (press) press.current = set;
  useEffect(() => () => clearTimeout(timer.current), []);
  const isKey = (event: KeyboardEvent): boolean => event.key === "Enter" || event.key === " ";
  return (
    <button class={`${calm ? "hold" : "stop"} ${holding ? "holding" : ""}`} disabled={disabled}
      title={hint ?? t("hold to confirm (or hold S)")}
      onPointerDown={(event) => event.button === 0 && set(true)} onPointerUp={() => set(false)}
      onPointerLeave={() => set(false)} onPointerCancel={() => set(false)}
      onKeyDown={(event) => isKey(event) && !event.repeat && set(true)}
      onKeyUp={(event) => isKey(event) && set(false)} onBlur={() => set(false)}
      onContextMenu={(event) => event.preventDefault()}>
      <b>{label}</b><small>{t("hold")}</small>
    </button>
  );
}

interface StopProps { session: Session; press: RefObject<(pressed: boolean) => void> }

export function StopButton({ session, press }: StopProps) {
  const vehicle = session.commanded;
  return (
    <HoldButton label={`STOP ${vehicle}`} press={press}
      act={() => void order(session, vehicle, "stop")} />
  );
}
