// SPDX-License-Identifier: Apache-2.0
// Bundles the page to dist/: everything local, the scene and the plots in chunks of their own.
import { build } from "esbuild";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? join(here, "dist"));
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const { metafile } = await build({
  metafile: true,
  absWorkingDir: here,
  entryPoints: ["src/links.ts", "src/main.tsx", "src/scene/scene_worker.ts", "src/style.css"],
  outdir: out,
  entryNames: "[name]",
  chunkNames: "[name]-[hash]",
  bundle: true,
  splitting: true,
  format: "esm",
  target: "es2022",
  minify: process.env["PLAIN"] === undefined,
  legalComments: "linked",
  jsx: "automatic",
  jsxImportSource: "preact",
  logLevel: "warning",
});
// What the links need is asked for at once, not when they have come.
const { imports } = Object.entries(metafile.outputs).find(([path]) => path.endsWith("links.js"))[1];
const preloads = imports.map(({ path }) => `<link rel="modulepreload" href="${basename(path)}" />`);
writeFileSync(join(out, "index.html"), readFileSync(join(here, "index.html"), "utf8")
  .replace("    <script", `${preloads.map((link) => `    ${link}\n`).join("")}    <script`));
cpSync(join(here, "icon.svg"), join(out, "icon.svg"));
// Languages besides English; each file says its own name.
cpSync(join(here, "words"), join(out, "words"), { recursive: true });
const languages = readdirSync(join(here, "words")).filter((file) => file.endsWith(".json"))
  .map((file) => [file.slice(0, -5), JSON.parse(readFileSync(join(here, "words", file)))[""]]);
writeFileSync(join(out, "words/index.json"), JSON.stringify([["en", "English"], ...languages]));
