// SPDX-License-Identifier: Apache-2.0
// The one way from any source to the store: thin out, decode, hand over.
import { Decoders } from "./decode.ts";
import type { RawSample, Sample } from "./sample.ts";
import { isOnDemand, partsOf, readingOf } from "./topics.ts";

const slow_s = 0.5;
const frame_s = 1 / 40;

export class Intake {
  private readonly decoders: Decoders;
  private later: RawSample[] = []; // of channels whose schemas were not read yet
  private readonly decoded_s = new Map<string, number>(); // by topic: log time of the last decoding

  constructor(report: (problem: string) => void) {
    this.decoders = new Decoders(report);
  }

  /** After a jump in time. */
  reset(): void {
    this.decoded_s.clear();
    this.later = [];
  }

  /**
   * In the order of the batch. Every sample is counted, those worth it are decoded. To read a schema
   * takes milliseconds: no more than `schemas` of them are read, pictures' first; samples of others
   * wait for the next call.
   */
  take(batch: RawSample[], schemas = Infinity): Sample[] {
    const ready = this.readable([...this.later, ...batch], schemas);
    const newest = new Map<string, RawSample>();
    for (const raw of ready) newest.set(raw.channel.topic, raw);
    return ready.map((raw) => this.sample(raw, newest.get(raw.channel.topic) === raw));
  }

  private readable(batch: RawSample[], schemas: number): RawSample[] {
    const fresh = new Set(batch.map((raw) => raw.channel).filter((channel) =>
      readingOf(channel.topic) !== undefined && !this.decoders.knows(channel)));
    const first = [...fresh].sort((a, b) => Number(isOnDemand(b.topic)) - Number(isOnDemand(a.topic)));
    const waiting = new Set(first.slice(Math.min(schemas, first.length)));
    this.later = batch.filter((raw) => waiting.has(raw.channel));
    return waiting.size === 0 ? batch : batch.filter((raw) => !waiting.has(raw.channel));
  }

  private sample(raw: RawSample, isNewest: boolean): Sample {
    const { topic, schemaName } = raw.channel;
    const { vehicle, name } = partsOf(topic);
    const wanted = raw.data !== null && this.isWanted(raw, isNewest);
    if (wanted) this.decoded_s.set(topic, raw.time_s);
    const message = wanted ? this.decoders.decode(raw.channel, raw.data!) : undefined;
    const { time_s, bytes } = raw;
    return { topic, vehicle, name, type: schemaName, time_s, bytes, message };
  }

  // A batch may be one frame of a live view or thirty seconds of a recording.
  private isWanted(raw: RawSample, isNewest: boolean): boolean {
    const reading = readingOf(raw.channel.topic);
    if (reading === undefined) return false;
    if (reading === "all") return true;
    const since_s = raw.time_s - (this.decoded_s.get(raw.channel.topic) ?? -Infinity);
    const period_s = reading === "slow" ? slow_s : frame_s;
    return since_s >= period_s || (isNewest && reading === "newest");
  }
}
