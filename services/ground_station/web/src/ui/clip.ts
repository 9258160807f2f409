// SPDX-License-Identifier: Apache-2.0
// The last seconds of what is shown as a film, which the station makes of its recording.
import type { Session } from "./session.ts";
import { download } from "./download.ts";
import { t } from "./words.ts";

const clip_s = 20;

export interface Span { file: string; from_s: number; to_s: number } // from the recording's beginning

interface Shown {
  readonly replay: { recording: { name: string; begin_s: number }; time_s(): number } | null;
  readonly liveState: { station: { message: { recording: { active: boolean; file: string;
    seconds: number } | null } } | null };
}

/** null: nothing is recorded. */
export function spanOf({ replay, liveState }: Shown): Span | null {
  const live = liveState.station?.message.recording;
  if (!replay && !live?.active) return null;
  const to_s = replay ? replay.time_s() - replay.recording.begin_s : live!.seconds;
  return { file: replay ? replay.recording.name : live!.file,
    from_s: Math.max(0, to_s - clip_s), to_s };
}

export async function saveClip(session: Session): Promise<void> {
  const span = spanOf(session);
  if (!span) return session.notice(t("Nothing is recorded: start it under Recordings."), true);
  const vehicle = session.vehicle?.name ?? "";
  const name = span.file.replace(/\.mcap$/, "");
  const query = new URLSearchParams({ vehicle, from_s: span.from_s.toFixed(2),
    to_s: span.to_s.toFixed(2) });
  session.notice(t("The clip is being made …"));
  try {
    const answer = await fetch(`clips/${encodeURIComponent(name)}.webm?${query}`,
      { headers: session.operator.headers() });
    if (!answer.ok) throw new Error((await answer.text()) || `HTTP ${answer.status}`);
    download(await answer.blob(), `${name}_${vehicle}_${span.from_s.toFixed(0)}s.webm`);
    session.notice("");
  } catch (error) {
    session.notice(t("There is no clip: {why}", { why: (error as Error).message }), true);
  }
}
