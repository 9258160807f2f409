// SPDX-License-Identifier: Apache-2.0
// The station's report of one of its recordings, in a tab of its own.
import type { Session } from "./session.ts";
import { t } from "./words.ts";

export async function openReport(session: Session, file: string): Promise<void> {
  const tab = window.open("", "_blank"); // at the click: later it would be a pop-up
  session.notice(t("{file} is being read …", { file }));
  try {
    const name = encodeURIComponent(file.replace(/\.mcap$/, ""));
    const answer = await fetch(`reports/${name}.html`, { headers: session.operator.headers() });
    if (!answer.ok) throw new Error((await answer.text()) || `HTTP ${answer.status}`);
    const url = URL.createObjectURL(new Blob([await answer.text()], { type: "text/html" }));
    if (tab) tab.location.href = url;
    else location.href = url;
    session.notice("");
  } catch (error) {
    tab?.close();
    session.notice(t("{file} cannot be told: {why}", { file, why: (error as Error).message }), true);
  }
}
