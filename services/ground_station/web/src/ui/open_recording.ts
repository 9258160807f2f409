// SPDX-License-Identifier: Apache-2.0
// Opens a recording, of this machine or of the station, and shows it. What reads MCAP is loaded
// only now.
import type { Session } from "./session.ts";
import { t } from "./words.ts";

export async function openRecording(session: Session, from: File | string): Promise<void> {
  const name = typeof from === "string" ? from : from.name;
  session.notice(t("opening {file} …", { file: name }));
  try {
    const { openMcap, readableAt, readableOf } = await import("../data/open_recording.ts");
    const readable = typeof from === "string"
      ? readableAt(`recordings/${encodeURIComponent(from)}`, session.operator.headers())
      : readableOf(from);
    session.startReplay(await openMcap(name, readable));
    session.notice("");
  } catch (error) {
    session.notice(t("{file} cannot be replayed: {why}",
      { file: name, why: (error as Error).message }));
  }
}
