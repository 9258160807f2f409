// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a recording come from: a file of this machine, or the station.
import type { IReadable } from "@mcap/core";

export function readableOf(file: Blob): IReadable {
  return {
    size: async () => BigInt(file.size),
    read: async (offset, size) => {
      const end = Number(offset) + Number(size);
      return new Uint8Array(await file.slice(Number(offset), end).arrayBuffer());
    },
  };
}

/** Reads in blocks of 1 MiB and keeps the last ones, as an index is many small reads. */
export function readableAt(url: string, headers: Record<string, string> = {}): IReadable {
  const block = 1 << 20;
  const kept = new Map<number, Promise<Uint8Array>>();
  let size: number | null = null;
  const fetchRange = async (begin: number, end: number): Promise<Uint8Array> => {
    const Range = `bytes=${begin}-${end - 1}`;
    const answer = await fetch(url, { headers: { ...headers, Range } });
    if (answer.status !== 206) throw new Error(`${url}: HTTP ${answer.status}, 206 expected`);
    size ??= Number(/\/(\d+)$/.exec(answer.headers.get("Content-Range") ?? "")?.[1]);
    return new Uint8Array(await answer.arrayBuffer());
  };
  const blockAt = (index: number): Promise<Uint8Array> => {
    let data = kept.get(index);
    if (!data) {
      data = fetchRange(index * block, Math.min((index + 1) * block, size ?? Infinity));
      data.catch(() => kept.delete(index));
      kept.set(index, data);
      if (kept.size > 48) kept.delete(kept.keys().next().value!);
    }
    return data;
  };
  return {
    size: async () => {
      if (size === null) await fetchRange(0, 1);
      return BigInt(size!);
    },
    read: async (offset, length) => {
      const [begin, end] = [Number(offset), Number(offset + length)];
      const out = new Uint8Array(end - begin);
      for (let i = Math.floor(begin / block); i * block < end; i++) {
        const data = await blockAt(i);
        const from = Math.max(0, begin - i * block);
        const part = data.subarray(from, end - i * block);
        out.set(part, i * block + from - begin);
      }
      return out;
    },
  };
}
