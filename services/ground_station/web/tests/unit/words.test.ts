// SPDX-License-Identifier: Apache-2.0
// The page's words against the contract and the terminal view.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import * as words from "../../src/data/words.ts";
import { projectFolder } from "../flat_idl.mjs";

const text = (path: string): string => readFileSync(join(projectFolder, path), "utf8");

/** The highest value of the constants PREFIX_… of a message. */
function highest(message: string, prefix: string): number {
  const idl = text(`idl/${message.replace("/", "/msg/")}.idl`);
  const values = [...idl.matchAll(new RegExp(`const uint8 ${prefix}_\\w+ = (\\d+)`, "g"))];
  return Math.max(...values.map((match) => Number(match[1])));
}

test("every enumerator of the contract has a word", () => {
  const all: [string, string, (index: number) => string][] = [
    ["foretrack_msgs/TargetState", "STATUS", words.trackWord],
    ["foretrack_msgs/TargetPrediction", "STATUS", words.predictionWord],
    ["foretrack_msgs/PlannedTrajectory", "STATUS", words.planWord],
    ["foretrack_msgs/PlannedTrajectory", "REASON", words.explainPlan],
    ["foretrack_msgs/TargetSearch", "MODE", words.searchWord],
    ["foretrack_msgs/SafetyState", "MODE", words.modeWord],
    ["foretrack_msgs/SafetyState", "REASON", words.explainGate],
    ["foretrack_msgs/SafetyState", "PHASE", words.phaseWord],
    ["foretrack_msgs/SafetyState", "RESULT", words.resultWord],
    ["foretrack_msgs/SafetyState", "END", words.explainEnd],
    ["foretrack_msgs/ServiceHealth", "STATE", words.serviceWord],
    ["foretrack_msgs/MissionCommand", "COMMAND", words.commandWord],
    ["px4_msgs/BatteryStatus", "WARNING", words.batteryWord],
  ];
  for (const [message, prefix, word] of all)
    for (let value = 0; value <= highest(message, prefix); value++)
      assert.notEqual(word(value), "unknown", `${message} ${prefix} ${value}`);
});

test("the terminal view says the same", () => {
  const terminal = text("services/operator/words.cpp");
  for (const word of [words.trackWord, words.predictionWord, words.planWord, words.modeWord,
    words.serviceWord, words.explainPlan, words.explainGate])
    for (let value = 0; word(value) !== "unknown"; value++)
      assert.ok(terminal.includes(`"${word(value)}"`), word(value));
});
