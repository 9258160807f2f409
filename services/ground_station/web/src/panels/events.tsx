// SPDX-License-Identifier: Apache-2.0
// Alarms that hold or were not acknowledged, and all events, newest first.
import { sortedAlarms } from "../store/alarms.ts";
import type { Alarm } from "../store/state.ts";
import { timeOfDay } from "../ui/format.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { SeveritySign } from "./badge.tsx";

const shownEvents = 200;

function AlarmRow({ session, alarm }: { session: Session; alarm: Alarm }) {
  const over = alarm.cleared_s !== null;
  return (
    <tr class={`alarm ${alarm.severity} ${alarm.acknowledged ? "seen" : ""} ${over ? "over" : ""}`}
      data-alarm={alarm.key}>
      <td><SeveritySign severity={alarm.severity} /></td>
      <td>{timeOfDay(alarm.since_s)}</td>
      <td>{alarm.vehicle}</td>
      <td>{alarm.text}{over ? ` (${t("over at {time}", { time: timeOfDay(alarm.cleared_s!) })})` : ""}</td>
      <td>{alarm.acknowledged ? t("acknowledged") : (
        <button onClick={() => session.tell({ kind: "acknowledge", key: alarm.key })}>
          {t("Acknowledge")}</button>
      )}</td>
    </tr>
  );
}

export function EventsPanel({ session }: { session: Session }) {
  const { state } = session;
  const alarms = sortedAlarms(state);
  const events = state.events.slice(-shownEvents).reverse();
  return (
    <div class="events">
      {alarms.some((a) => !a.acknowledged) ? (
        <div class="row"><b>{t("Alarms")}</b>
          <button onClick={() => session.tell({ kind: "acknowledge", key: "all" })}>
            {t("Acknowledge all (A)")}</button></div>
      ) : null}
      {alarms.length > 0 ? (
        <table class="alarmlist" aria-label={t("alarms")}><tbody>
          {alarms.map((a) => <AlarmRow key={a.key} session={session} alarm={a} />)}
        </tbody></table>
      ) : null}
      <table aria-label={t("events")}><tbody>
        {events.map((event) => (
          <tr key={event.id} class={event.severity}>
            <td><SeveritySign severity={event.severity} /></td>
            <td>{timeOfDay(event.time_s, 1)}</td>
            <td>{event.vehicle}</td>
            <td>{event.text}</td>
          </tr>
        ))}
      </tbody></table>
      {events.length === 0 ? <p class="empty">{t("Nothing has happened yet.")}</p> : null}
    </div>
  );
}
