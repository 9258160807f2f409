// SPDX-License-Identifier: Apache-2.0
interface Size { width: number; height: number }
export function keyPicture(size: Size, paint: (x: number, y: number) => number[]): Uint8Array;
export function repeatedPicture(size: Size, number: number): Uint8Array;
