// SPDX-License-Identifier: Apache-2.0
export function encode(type: string, message: unknown): Uint8Array;
export function schemaNameOf(type: string): string;
export function typeOf(name: string): string;
export function samplesAt(t: number, step: number, index: number, orders?: object):
  [string, unknown][];
export function safety(t: number, more?: object): object;
export const colors_rgb: Record<string, number>;
export function probabilities(t: number): Record<string, number>;
export function vehicleAt(t: number, index?: number):
  { x: number; y: number; z: number; yaw: number; behind: number };
export function peopleAt(t: number, index?: number):
  { id: number; x: number; y: number; yaw: number; speed: number }[];
export function diagnosticsOf(t: number, name: string, band: [number, number]):
  { status: { values: { key: string; value: string }[] }[] };
export const origin: { lat_deg: number; lon_deg: number };
