// SPDX-License-Identifier: Apache-2.0
// Orders and leases, and what came of them.
import { outcome } from "../data/words.ts";
import { adviceFor } from "./advice.ts";
import type { Command, LeaseAction, OrderDetails } from "./operator.ts";
import type { Session } from "./session.ts";
import { said, t } from "./words.ts";

/** Whether it was taken. */
export async function order(session: Session, vehicle: string, command: Command,
                            details?: OrderDetails): Promise<boolean> {
  if (!vehicle) {
    session.notice(t("no vehicle to command"));
    return false;
  }
  session.notice(`${command} ${vehicle} …`);
  const { ok, reason, answered } = await session.operator.command(vehicle, command, details);
  const word = answered === false ? said("NOT CONFIRMED") : said("refused");
  const result = ok ? t("sent") : outcome(t(word), reason);
  const advice = ok ? "" : adviceFor(reason);
  session.notice(`${command} ${vehicle}: ${result}${advice && `. ${advice}`}`, !ok);
  return ok;
}

export async function lease(session: Session, vehicle: string, action: LeaseAction,
                            to?: string): Promise<void> {
  const { ok, reason } = await session.operator.lease(vehicle, action, to);
  const words = { take: t("control taken"), release: t("control released"),
    hand_over: t("handed over") };
  session.notice(ok ? `${vehicle}: ${words[action]}` : `${vehicle}: ${outcome(t("refused"), reason)}`, !ok);
}

export async function record(session: Session, action: "start" | "stop"): Promise<void> {
  const { ok, reason } = await session.operator.record(action);
  session.notice(ok ? (action === "start" ? t("recording: started") : t("recording: ended"))
    : t("recording: {why}", { why: outcome(t("refused"), reason) }), !ok);
}
