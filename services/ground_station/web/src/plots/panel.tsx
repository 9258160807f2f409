// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "preact/hooks";

import { useModule } from "../ui/hooks.ts";
import { changeSpan, spans_s } from "../ui/keys.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";

const period_ms = 120;

export function Plots({ session }: { session: Session }) {
  const host = useRef<HTMLDivElement>(null);
  const stack = useModule(() => session.settled.then(() => import("./stack.ts")));
  useEffect(() => {
    if (!stack || !host.current) return;
    const charts = new stack.ChartStack(session, host.current);
    let turn = 0;
    const timer = setInterval(() => { // every other time where the scene takes long
      if (turn++ % 2 === 0 || !session.drawsSlowly) charts.update();
    }, period_ms);
    return () => {
      clearInterval(timer);
      charts.destroy();
    };
  }, [stack]);
  return (
    <section class="plots" aria-label={t("plots")}>
      <div class="charts" ref={host} />
      <nav class="spans" aria-label={t("time shown")}>
        {spans_s.map((span_s) => (
          <button key={span_s} aria-pressed={session.span_s === span_s}
            onClick={() => changeSpan(session, spans_s.indexOf(span_s) -
              spans_s.indexOf(session.span_s))}>{span_s} s</button>
        ))}
      </nav>
    </section>
  );
}
