// SPDX-License-Identifier: Apache-2.0
// node tests/run.mjs types: checks the types. node tests/run.mjs unit|browser|flight|measure: bundles
// tests/<kind>/*.test.ts and runs them by node's runner; of them only <name>.test.ts with a third word.
// Exits with 77, which ctest takes for skipped, where npm's packages were not installed.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const web = dirname(here);
const kind = process.argv[2] ?? "unit";
const only = process.argv[3] ?? "";
if (!existsSync(join(web, "node_modules"))) {
  console.log("skipped: the page's packages are not installed (npm ci, or ./run build)");
  process.exit(77);
}
if (kind === "types") {
  const tsc = join(web, "node_modules/typescript/bin/tsc");
  process.exit(spawnSync(process.execPath, [tsc, "--noEmit", "-p", web],
    { stdio: "inherit" }).status ?? 1);
}
if ((kind === "flight" || kind === "measure") && !existsSync(process.env["FORETRACK_PROGRAM"] ?? "")) {
  console.log("skipped: FORETRACK_PROGRAM is not the program");
  process.exit(77);
}
if (kind !== "unit" && !(await import("./chromium.mjs")).hasChromium) {
  console.log("skipped: no Chromium (Debian package chromium)");
  process.exit(77);
}
if (kind !== "unit") spawnSync(process.execPath, ["build.mjs"], { stdio: "inherit", cwd: web });
const { build } = await import("esbuild");
const out = join(web, "node_modules", ".tests", kind);
rmSync(out, { recursive: true, force: true });
const names = readdirSync(join(here, kind)).filter((name) => name.endsWith(".test.ts"))
  .filter((name) => only === "" || name === `${only}.test.ts`);
await build({ absWorkingDir: web, entryPoints: names.map((name) => join("tests", kind, name)),
  outdir: out, outExtension: { ".js": ".mjs" }, bundle: true, platform: "node", format: "esm",
  external: ["playwright-core", "ws"], mainFields: ["module", "main"], target: "node18",
  banner: { js: 'import { createRequire } from "node:module";' +
    "const require = createRequire(import.meta.url);" },
  jsx: "automatic", jsxImportSource: "preact",  logLevel: "warning" });
const files = names.map((name) => join(out, name.replace(/\.ts$/, ".mjs")));
const { status } = spawnSync(process.execPath, ["--test", ...files],
  { stdio: "inherit", cwd: web });
process.exit(status ?? 1);
