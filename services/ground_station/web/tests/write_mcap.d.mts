// SPDX-License-Identifier: Apache-2.0
export function syntheticRecording(
  options: { begin_s: number; seconds: number; vehicles?: string[]; pictures?: boolean; video?: boolean }): Promise<Uint8Array>;
