// SPDX-License-Identifier: Apache-2.0
export function boxOf(t: number, index: number, at: { x: number; y: number }): number[] | null;
export function pictureAt(t: number, index: number): [string, unknown][];
export function colorInfoAt(t: number): [string, unknown];
export function png(size: { width: number; height: number },
  paint: (x: number, y: number) => number[]): Uint8Array;
