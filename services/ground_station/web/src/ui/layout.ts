// SPDX-License-Identifier: Apache-2.0
// How scene and picture share the page, which this browser keeps.
export type Layout = "inset" | "picture" | "scene";

const key = "foretrack.layout";
export const narrowQuery = "(max-width: 820px)";
export const isNarrow = (): boolean => matchMedia(narrowQuery).matches;

export const keptLayout = (): Layout => (localStorage.getItem(key) as Layout | null) ?? "inset";
export const keepLayout = (layout: Layout): void => localStorage.setItem(key, layout);

/** As the page will begin: before anything of it is drawn, its picture can be asked for. */
export const beginsWithPicture = (): boolean => !isNarrow() && keptLayout() !== "scene";
