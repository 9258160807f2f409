// SPDX-License-Identifier: Apache-2.0
// Recordings of the station and of this machine: start, stop, replay, download.
import { useEffect, useState } from "preact/hooks";

import type { Recording } from "../data/station.ts";
import { bytes } from "../ui/format.ts";
import { openRecording } from "../ui/open_recording.ts";
import { openReport } from "../ui/open_report.ts";
import { record } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";

function useRecordings(session: Session): { list: Recording[]; problem: string } {
  const [list, setList] = useState<Recording[]>([]);
  const [problem, setProblem] = useState("");
  const active = session.liveState.station?.message.recording?.active;
  useEffect(() => {
    const load = (): void => void session.operator.recordings()
      .then((found) => {
        setList(found);
        setProblem("");
      })
      .catch((error: Error) => setProblem(error.message));
    load();
    const timer = setInterval(load, 5000);
    return () => clearInterval(timer);
  }, [active]);
  return { list, problem };
}

export function RecordingsPanel({ session }: { session: Session }) {
  const { list, problem } = useRecordings(session);
  const { station } = session.liveState;
  const active = station?.message.recording?.active ?? false;
  return (
    <div class="recordings">
      <div class="row">
        <button onClick={() => void record(session, active ? "stop" : "start")}>
          {active ? t("Stop recording") : t("Record")}</button>
        <label class="file">{t("Open a file …")}
          <input type="file" accept=".mcap" aria-label="open a recording"
            onChange={(event) => {
              const file = event.currentTarget.files?.[0];
              if (file) void openRecording(session, file);
            }} /></label>
        <output class={session.message.bad ? "bad" : ""}>{session.message.text}</output>
      </div>
      <table aria-label="recordings"><tbody>
        {list.map((r) => (
          <tr key={r.file}>
            <td>{r.file}</td>
            <td class="n">{bytes(r.bytes)}</td>
            <td><button onClick={() => void openRecording(session, r.file)}>{t("Replay")}</button>
              {" "}<button onClick={() => void openReport(session, r.file)}>{t("Report")}</button>
              {" "}<a href={`recordings/${encodeURIComponent(r.file)}`} download>{t("Download")}</a></td>
          </tr>
        ))}
      </tbody></table>
      {list.length === 0 ? (
        <p class="empty">{problem ? t("The station lists none: {why}", { why: problem })
          : t("No recordings yet. An MCAP file can also be dropped on the page.")}</p>
      ) : null}
    </div>
  );
}
