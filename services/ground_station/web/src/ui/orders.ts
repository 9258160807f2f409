// SPDX-License-Identifier: Apache-2.0
// Orders and leases, and what came of them.
import { outcome } from "../data/words.ts";
import type { Command, LeaseAction } from "./operator.ts";
import type { Session } from "./session.ts";

export async function order(session: Session, vehicle: string, command: Command): Promise<void> {
  if (!vehicle) return session.notice("no vehicle to command");
  session.notice(`${command} ${vehicle} …`);
  const { ok, reason, answered } = await session.operator.command(vehicle, command);
  const word = answered === false ? "NOT CONFIRMED" : "refused";
  const result = ok ? "sent" : outcome(word, reason);
  session.notice(`${command} ${vehicle}: ${result}`, !ok);
}

export async function lease(session: Session, vehicle: string, action: LeaseAction,
                            to?: string): Promise<void> {
  const { ok, reason } = await session.operator.lease(vehicle, action, to);
  const words = { take: "control taken", release: "control released", hand_over: "handed over" };
  session.notice(ok ? `${vehicle}: ${words[action]}` : `${vehicle}: ${outcome("refused", reason)}`, !ok);
}

export async function record(session: Session, action: "start" | "stop"): Promise<void> {
  const { ok, reason } = await session.operator.record(action);
  session.notice(ok ? `recording: ${action === "start" ? "started" : "ended"}`
    : `recording: ${outcome("refused", reason)}`, !ok);
}
