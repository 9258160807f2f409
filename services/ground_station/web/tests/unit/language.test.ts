// SPDX-License-Identifier: Apache-2.0
// Every text that the page shows can be said in every language that ships.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { allWords } from "../../src/data/words.ts";
import { speak, t } from "../../src/ui/words.ts";
import { projectFolder } from "../flat_idl.mjs";

const web = join(projectFolder, "services/ground_station/web");

function sourcesIn(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? sourcesIn(path) : /\.tsx?$/.test(path) ? [path] : [];
  });
}

/** What stands in t("…") and said("…"), also in pieces. */
function textsOf(source: string): string[] {
  const calls = source.matchAll(/\b(?:t|said)\(\s*((?:"(?:[^"\\]|\\.)*"\s*(?:\+\s*)?)+)/g);
  return [...calls].map(([, pieces]) => [...pieces!.matchAll(/"((?:[^"\\]|\\.)*)"/g)]
    .map(([, piece]) => JSON.parse(`"${piece}"`) as string).join(""));
}

const shown = new Set([...allWords,
  ...sourcesIn(join(web, "src")).flatMap((path) => textsOf(readFileSync(path, "utf8")))]);
const files = readdirSync(join(web, "words")).filter((name) => name.endsWith(".json"));

test("there are texts, and a language besides English", () => {
  assert.ok(shown.size > 150, `${shown.size}`);
  assert.ok(files.includes("de.json"));
});

for (const file of files)
  test(`${file} has every text, and none that is no longer shown`, () => {
    const words = JSON.parse(readFileSync(join(web, "words", file), "utf8")) as Record<string, string>;
    const { "": name, ...texts } = words;
    assert.ok(name, "its own name stands under \"\"");
    assert.deepEqual([...shown].filter((text) => !(text in texts)).sort(), []);
    assert.deepEqual(Object.keys(texts).filter((text) => !shown.has(text)).sort(), []);
    const holes = (text: string): string => (text.match(/\{\w+\}/g) ?? []).sort().join();
    assert.deepEqual(Object.keys(texts).filter((text) => holes(text) !== holes(texts[text]!)), []);
  });

test("a text that a language lacks stays English, and values are filled in", () => {
  speak({ "person {id}": "Person {id}" });
  assert.equal(t("person {id}", { id: 3 }), "Person 3");
  assert.equal(t("no picture"), "no picture");
  assert.equal(t("{age} old", { age: "2 s" }), "2 s old");
  speak({});
});
