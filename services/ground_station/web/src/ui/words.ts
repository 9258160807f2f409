// SPDX-License-Identifier: Apache-2.0
// The page's words in other languages. In the sources they stand in English, in calls of t(); a language
// is a file words/<code>.json from those to its own. A text that is missing there stays English.

export type Words = Record<string, string>;

const key = "foretrack.language";
let words: Words = {};

/** The text in the language that is shown; {name} is filled in. */
export function t(text: string, values: Record<string, string | number> = {}): string {
  return (words[text] ?? text).replace(/\{(\w+)\}/g, (whole, name: string) =>
    name in values ? String(values[name]) : whole);
}

/** Marks a text of a table, which is shown by t() later. */
export const said = (text: string): string => text;

export function speak(language: Words): void {
  words = language;
}

/** Codes and names of the files in words/, as the bundle lists them. */
export async function languages(): Promise<[string, string][]> {
  const answer = await fetch("words/index.json").catch(() => null);
  return answer?.ok ? (await answer.json()) as [string, string][] : [];
}

/** What was chosen here, else what the browser asks for. */
export function chosenLanguage(): string {
  return localStorage.getItem(key) ?? navigator.language.slice(0, 2);
}

/** Before anything is drawn. English, where there is no such file. */
export async function loadLanguage(code = chosenLanguage()): Promise<void> {
  document.documentElement.lang = "en";
  if (code === "en") return speak({});
  const answer = await fetch(`words/${encodeURIComponent(code)}.json`).catch(() => null);
  if (!answer?.ok) return speak({});
  speak((await answer.json()) as Words);
  document.documentElement.lang = code;
}

export function chooseLanguage(code: string): void {
  localStorage.setItem(key, code);
  location.reload();
}
