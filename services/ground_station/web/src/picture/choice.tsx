// SPDX-License-Identifier: Apache-2.0
// Who is followed and how sure that is; and the question which of them it is, where it is not.
import { useEffect, useState } from "preact/hooks";

import type { ChoiceCandidate, TargetChoice } from "../data/messages.ts";
import { Choice, choiceWord } from "../data/words.ts";
import { age_s } from "../store/state.ts";
import type { Session } from "../ui/session.ts";
import { t } from "../ui/words.ts";
import { follow, whyNotChoose } from "./people.tsx";

const stale_s = 2; // it comes five times a second

/** undefined: nothing is heard of it, or no longer. */
export function choiceOf(session: Session): TargetChoice | undefined {
  const heard = session.vehicle?.latest["target/choice"];
  return heard && age_s(session.state, heard) < stale_s ? heard.message : undefined;
}

const percent = (share: number): string => `${Math.round(100 * share)} %`;

/** In a sentence. */
export function choiceText(choice: TargetChoice): string {
  const { state, person_id, likeness } = choice;
  if (state === Choice.waiting) return t("nobody is followed yet: tap a person in the picture");
  if (person_id === 0) return t(choiceWord(state));
  const who = t("person {id}", { id: person_id });
  return state === Choice.following
    ? t("following {who}, {sure} sure", { who, sure: percent(likeness) })
    : `${t(choiceWord(state))}: ${who}`;
}

export function ChoiceLine({ session }: { session: Session }) {
  const choice = choiceOf(session);
  if (!choice) return null;
  const bad = choice.state === Choice.doubtful || choice.state === Choice.lost;
  return (
    <output class={`choiceline ${bad ? "bad" : ""}`} data-field="choice-line">
      {choiceText(choice)}</output>
  );
}

/** JPEG bytes as an image; freed when it goes. */
function Portrait({ bytes, label }: { bytes: Uint8Array; label: string }) {
  const [url, setUrl] = useState("");
  const key = `${bytes.length} ${bytes[bytes.length >> 1] ?? 0} ${bytes[bytes.length >> 2] ?? 0}`;
  useEffect(() => {
    if (bytes.length === 0) return setUrl("");
    const made = URL.createObjectURL(new Blob([bytes.slice()], { type: "image/jpeg" }));
    setUrl(made);
    return () => URL.revokeObjectURL(made);
  }, [key]);
  return url ? <img src={url} alt={label} /> : <span class="noportrait">{t("no picture")}</span>;
}

function Candidate({ session, candidate, why }:
    { session: Session; candidate: ChoiceCandidate; why: string }) {
  const who = t("person {id}", { id: candidate.person_id });
  return (
    <figure>
      <Portrait bytes={candidate.picture} label={who} />
      <figcaption>{who}, {t("{share} alike", { share: percent(candidate.likeness) })}</figcaption>
      <button disabled={why !== ""} title={why}
        onClick={() => void follow(session, candidate.person_id)}>{t("This one")}</button>
    </figure>
  );
}

/** Only while perception is in doubt. */
export function ChoiceDialog({ session }: { session: Session }) {
  const choice = choiceOf(session);
  if (!choice || choice.state !== Choice.doubtful || choice.candidates.length === 0) return null;
  const why = whyNotChoose(session);
  return (
    <section class="choice" role="alertdialog" aria-label={t("Who is it?")}>
      <h2>■ {t("Who is it?")}</h2>
      <p>{t("Several people could be the one who is followed.")}
        {choice.waits_s > 0
          ? ` ${t("Without an answer it goes on in {seconds} s.",
            { seconds: Math.ceil(choice.waits_s) })}` : ""}</p>
      <div class="row">
        {choice.picture.length > 0 ? (
          <figure class="before"><Portrait bytes={choice.picture} label={t("who was chosen")} />
            <figcaption>{t("who was chosen")}</figcaption></figure>
        ) : null}
        {choice.candidates.map((candidate) => (
          <Candidate key={candidate.person_id} session={session} candidate={candidate} why={why} />
        ))}
      </div>
      <div class="row">
        <button disabled={why !== ""} title={why} onClick={() => void follow(session, 0)}>
          {t("None of them")}</button>
        {why ? <small>{why}</small> : null}
      </div>
    </section>
  );
}
