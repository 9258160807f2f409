// SPDX-License-Identifier: Apache-2.0
// The schema of a type as one text: its IDL file with all that it includes.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

// Also from where tests are bundled to.
let folder = dirname(fileURLToPath(import.meta.url));
while (!existsSync(join(folder, "idl/foretrack_msgs"))) folder = dirname(folder);
export const projectFolder = folder;

function flatten(path, seen) {
  if (seen.has(path)) return "";
  seen.add(path);
  return readFileSync(join(projectFolder, "idl", path), "utf8").split("\n").map((line) => {
    const included = /^#include "(.*)"/.exec(line);
    if (included) return flatten(included[1], seen);
    return line.startsWith("#") ? "" : line;
  }).join("\n");
}

/** "foretrack_msgs/TargetState" → its schema, as the station sends it. */
export function flatIdl(type) {
  const [pkg, name] = type.split("/");
  return flatten(`${pkg}/msg/${name}.idl`, new Set());
}
