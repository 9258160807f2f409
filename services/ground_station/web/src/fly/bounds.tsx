// SPDX-License-Identifier: Apache-2.0
// Where it may fly and where it returns to: on a map, and under it.
import { useEffect, useState } from "preact/hooks";

import { obstacle } from "../panels/commands.tsx";
import { type Bounds, boundsOf, homeOf } from "../store/derive.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import type { Corner } from "./fence.ts";
import { FencePart, noBounds, problemOf } from "./fence.tsx";
import { FlightMap, hereOf } from "./map.tsx";
import { ReturnPart } from "./return_place.tsx";

export function BoundsPanel({ session }: { session: Session }) {
  const [draft, setDraft] = useState<Bounds | null>(null);
  const [homeDraft, setHomeDraft] = useState<Corner | null>(null);
  const [placing, setPlacing] = useState(false);
  useEffect(() => void session.loadGround(), []);
  const vehicle = session.replay ? session.vehicle
    : session.liveState.vehicles.get(session.commanded);
  const why = session.replay ? t("a recording is shown") : obstacle(session);
  const safety = vehicle?.latest["safety/state"]?.message;
  const [isSet, set] = [boundsOf(safety), homeOf(safety)];
  const bounds = draft ?? isSet ?? noBounds;
  const home: Corner | null = set ? [set[0]!, set[1]!] : null;
  const here = hereOf(vehicle);
  const problem = problemOf(bounds, here);
  const hint = placing ? t("Click the map where it shall return to.") : t("Click the map to add " +
    "corners; drag to move them; Delete takes one away.");
  return (
    <section class="bounds" aria-label={t("fence")}>
      <h2>{t("Fence")} <small data-field="bounds">{draft ? t("drawn, not sent yet") : !isSet
        ? t("not known") : isSet.fence_m.length > 0 ? t("as it is set") : t("none is set")}</small></h2>
      <FlightMap session={session} vehicle={vehicle} drawing={{ fence: bounds.fence_m, home: homeDraft ?? home }}
        draws={why ? "nothing" : placing ? "home" : "fence"}
        change={(part) => {
          if (part.fence) setDraft({ ...bounds, fence_m: part.fence });
          if (part.home) setHomeDraft(part.home);
        }} />
      <FencePart session={session} bounds={bounds} draft={draft} why={why} problem={problem}
        setDraft={setDraft} />
      <p class="why">{why || problem || hint}</p>
      <ReturnPart session={session} home={home} draft={homeDraft} here={here} why={why}
        placing={placing} setDraft={setHomeDraft} setPlacing={setPlacing} />
    </section>
  );
}
