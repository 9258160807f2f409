// SPDX-License-Identifier: Apache-2.0
// Pictures of a video, by the browser's own decoder: each needs those before it, back to a key
// picture. H.264 in Annex B, one picture a message.
import { type CompressedVideo, type Header, seconds } from "../data/messages.ts";
import type { VideoRun } from "../store/video_run.ts";
import type { Outcome } from "./picture.ts";

const sequenceUnit = 7; // its parameter set, which tells profile and level

/** Whether this browser decodes such a video; some do so only over https or on this machine. */
export async function canShowVideo(): Promise<boolean> {
  if (!("VideoDecoder" in globalThis)) return false;
  const answer = await VideoDecoder.isConfigSupported({ codec: "avc1.42c01f" }).catch(() => null);
  return answer?.supported ?? false;
}

/** "avc1.PPCCLL" of the picture's parameter set; null: it has none. */
export function codecOf(data: Uint8Array): string | null {
  for (let i = 0; i + 6 < data.length; i++) {
    const begins = data[i] === 0 && data[i + 1] === 0 && data[i + 2] === 1;
    if (!begins || (data[i + 3]! & 0x1f) !== sequenceUnit) continue;
    const hex = (k: number): string => data[k]!.toString(16).padStart(2, "0");
    return `avc1.${hex(i + 4)}${hex(i + 5)}${hex(i + 6)}`;
  }
  return null;
}

export class VideoReader {
  private decoder: VideoDecoder | null = null;
  private fed = -1; // number of the last picture that the decoder has
  private faulty: { run: VideoRun | null; last: number } = { run: null, last: -1 }; // not tried again
  private run: VideoRun | null = null;
  private readonly headers = new Map<number, Header>(); // of those that it still works on

  constructor(private readonly outcome: Outcome) {}

  /** All of the run that the decoder does not have yet; from its key, where one was missed. */
  feed(run: VideoRun): void {
    if (run.first < 0 || run.last === this.fed) return;
    if (run === this.faulty.run && run.first <= this.faulty.last) return;
    this.run = run;
    const goesOn = this.decoder !== null && this.fed >= run.first - 1 && this.fed < run.last;
    const from = goesOn ? this.fed + 1 : run.first;
    for (let number = from; number <= run.last; number++)
      if (!this.decode(run.at(number), number === run.first)) return;
    this.fed = run.last;
  }

  close(): void {
    if (this.decoder && this.decoder.state !== "closed") this.decoder.close();
    this.decoder = null;
    this.fed = -1;
    this.headers.clear();
  }

  private decode(video: CompressedVideo, key: boolean): boolean {
    try {
      if (key) this.begin(video);
      const timestamp = Math.round(1e6 * seconds(video.timestamp));
      this.headers.set(timestamp, { stamp: video.timestamp, frame_id: video.frame_id });
      const data = video.data.slice(); // it is a view into a larger buffer, which goes on
      this.decoder!.decode(new EncodedVideoChunk({ type: key ? "key" : "delta", timestamp, data }));
      return true;
    } catch (error) {
      this.fail(error as Error);
      return false;
    }
  }

  // Keys come each second: the decoder is made anew only where it must be.
  private begin({ data, format }: CompressedVideo): void {
    if (this.decoder && this.decoder.state === "configured") return;
    const codec = codecOf(data);
    if (format !== "h264" || !codec) throw new Error(`h264 expected, not ${format || "nothing"}`);
    this.decoder = new VideoDecoder({ output: (frame) => this.give(frame),
      error: (error) => this.fail(error) });
    this.decoder.configure({ codec, optimizeForLatency: true });
  }

  private give(frame: VideoFrame): void {
    const header = this.headers.get(frame.timestamp);
    for (const stamp of this.headers.keys()) if (stamp <= frame.timestamp) this.headers.delete(stamp);
    if (!header) return frame.close();
    this.outcome.picture({ header, source: frame, width: frame.displayWidth,
      height: frame.displayHeight });
  }

  private fail(error: Error): void {
    this.faulty = { run: this.run, last: this.run?.last ?? -1 };
    this.close();
    this.outcome.problem(error.message);
  }
}
