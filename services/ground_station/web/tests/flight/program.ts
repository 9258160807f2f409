// SPDX-License-Identifier: Apache-2.0
// The real thing: foretrack's processes on a DDS domain of their own.
import { type ChildProcess, spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const program = process.env["FORETRACK_PROGRAM"] ?? "";
const [portBase, portsPerDomain] = [7400, 250];

// As services/launch/domain.cpp has it: domains whose ports nobody has bound.
function freeDomain(): number {
  const ports = ["/proc/net/udp", "/proc/net/udp6"].flatMap((table) =>
    readFileSync(table, "utf8").split("\n").slice(1).map((line) =>
      parseInt(/:([0-9A-F]{4}) /.exec(line)?.[1] ?? "0", 16)));
  const used = new Set(ports.map((port) => Math.floor((port - portBase) / portsPerDomain)));
  const free = Array.from({ length: 100 }, (_, i) => i + 1).filter((domain) => !used.has(domain));
  return free[Math.floor(Math.random() * free.length)]!;
}

export function stationOffers(option: string): boolean {
  return spawnSync(program, ["station", "--help"], { encoding: "utf8" }).stdout.includes(option);
}

/** Processes by name; all end with the flight. */
export class Flight {
  readonly domain = freeDomain();
  readonly folder = mkdtempSync(join(tmpdir(), "foretrack-page-"));
  readonly processes = new Map<string, ChildProcess>();
  output = "";

  start(name: string, ...args: string[]): ChildProcess {
    const child = spawn(program, [...args, "--domain", `${this.domain}`],
      { cwd: this.folder, stdio: ["ignore", "pipe", "pipe"] });
    for (const stream of [child.stdout, child.stderr])
      stream!.on("data", (text: Buffer) => (this.output += text.toString()));
    this.processes.set(name, child);
    return child;
  }

  service(vehicle: string, service: string, ...more: string[]): void {
    this.start(`${vehicle} ${service}`, service, "--vehicle", vehicle, "--use-sim-time",
      "--log-level", "info", "--state-dir", join(this.folder, vehicle), ...more);
  }

  /** An order from the terminal; whoever follows starts only then. */
  order(vehicle: string, what: string): void {
    this.start(`${vehicle} ${what}`, "order", what, "--vehicle", vehicle, "--for", "60");
  }

  signal(signal: NodeJS.Signals, ...names: string[]): void {
    for (const name of names) this.processes.get(name)!.kill(signal);
  }

  /** The address that the station prints. */
  async station(...args: string[]): Promise<string> {
    this.start("station", "station", "--port", "0", ...args);
    for (let i = 0; i < 300; i++) {
      const address = /https?:\/\/\S+/.exec(this.output)?.[0];
      if (address) return address;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    throw new Error(`the station prints no address:\n${this.output}`);
  }

  async end(): Promise<void> {
    const children = [...this.processes.values()]
      .filter((c) => c.exitCode === null && c.signalCode === null);
    const gone = children.map((c) => new Promise((resolve) => c.once("exit", resolve)));
    for (const child of children) {
      child.kill("SIGCONT");
      child.kill("SIGTERM");
    }
    const timer = setTimeout(() => children.forEach((c) => c.kill("SIGKILL")), 5000);
    await Promise.all(gone);
    clearTimeout(timer);
  }
}
