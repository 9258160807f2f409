// SPDX-License-Identifier: Apache-2.0
// Colours that the colour-blind can tell apart (after Okabe and Ito); never the only sign.

export const blue = "#56b4e9";
export const orange = "#e69f00";
export const green = "#2fc79b";
export const yellow = "#f0e442";
export const deep = "#4d8dff";
export const red = "#ff6b3d"; // vermillion, lighter
export const pink = "#d98cbb";
export const grey = "#8a97a5";

const cycle = [blue, orange, green, pink, yellow, deep, red, grey];
export const colorOf = (index: number): string => cycle[index % cycle.length]!;

/** turn_left → turn left */
export const spoken = (name: string): string => name.replaceAll("_", " ");

/** A message's color_rgb, 0xRRGGBB; recordings from before there was one are grey. */
export const colorOfRgb = (rgb: number | undefined): string =>
  rgb === undefined ? grey : `#${(rgb & 0xffffff).toString(16).padStart(6, "0")}`;

/** Track, coast, hover, brake, silent: lighter is worse, and each has its height in the ladder. */
export const modeColors = [blue, yellow, orange, red, pink];
