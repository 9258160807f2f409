// SPDX-License-Identifier: Apache-2.0
// Where `return` leads: set on the map, by numbers, or as where the vehicle is.
import { order } from "../ui/orders.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import type { Corner } from "./fence.ts";

function Metres({ label, value, disabled, set }:
    { label: string; value: number | null; disabled: boolean; set(value: number): void }) {
  return (
    <label>{label} <input type="number" step="0.5" disabled={disabled} placeholder="–"
      value={value === null ? "" : Number(value.toFixed(2))}
      onInput={(event) => {
        const { valueAsNumber } = event.currentTarget;
        if (Number.isFinite(valueAsNumber)) set(valueAsNumber);
      }} /> m</label>
  );
}

interface Props {
  session: Session;
  home: Corner | null; // as it is set
  draft: Corner | null;
  here: Corner | null; // where the vehicle is
  why: string; // it cannot be set
  placing: boolean; // a click on the map sets it
  setDraft(draft: Corner | null): void;
  setPlacing(placing: boolean): void;
}

export function ReturnPart(props: Props) {
  const { session, home, draft, here, why, placing, setDraft, setPlacing } = props;
  const editable = why === "";
  const [east, north] = draft ?? home ?? [null, null];
  const end = (): void => {
    setDraft(null);
    setPlacing(false);
  };
  const send = async (): Promise<void> => {
    const position_m: Corner = draft!;
    if (await order(session, session.commanded, "return_place", { position_m })) end();
  };
  return (
    <section class="returnplace" aria-label={t("return place")}>
      <h3>{t("Return place")} <small data-field="home">{draft ? t("drawn, not sent yet")
        : home ? t("{east} m east, {north} m north",
          { east: home[0].toFixed(1), north: home[1].toFixed(1) }) : t("not known")}</small></h3>
      <div class="row">
        <Metres label={t("east")} value={east} disabled={!editable}
          set={(x) => setDraft([x, north ?? 0])} />
        <Metres label={t("north")} value={north} disabled={!editable}
          set={(y) => setDraft([east ?? 0, y])} />
      </div>
      <div class="row">
        <button disabled={!editable} aria-pressed={placing} title={why}
          onClick={() => setPlacing(!placing)}>{t("On the map")}</button>
        <button disabled={!editable || !here} title={why}
          onClick={() => setDraft(here)}>{t("Here")}</button>
        <button disabled={!editable || !draft} title={why}
          onClick={() => void send()}>{t("Send return place")}</button>
        {draft || placing ? <button onClick={end}>{t("Discard")}</button> : null}
      </div>
    </section>
  );
}
