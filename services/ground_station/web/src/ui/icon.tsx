// SPDX-License-Identifier: Apache-2.0
// Signs that no font has to have. Who uses one says its name beside it.

const paths = {
  larger: "M9 2h5v5M14 2L9 7M7 14H2V9M2 14l5-5",
  smaller: "M14 7H9V2M9 7l5-5M2 9h5v5M7 9l-5 5",
  full: "M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4",
  camera: "M2 5h3l1.5-2h3L11 5h3v8H2zM8 11.2a2.4 2.4 0 1 0 0-4.8 2.4 2.4 0 0 0 0 4.8z",
  film: "M2 3h12v10H2zM5 3v10M11 3v10M2 6.3h3M2 9.7h3M11 6.3h3M11 9.7h3",
  clip: "M2 4h9v8H2zM11 7l4-2v6l-4-2M5 8h3M6.5 6.5v3",
  close: "M3 3l10 10M13 3L3 13",
  sound: "M2 6h3l4-3v10l-4-3H2zM11.5 5.5a4 4 0 0 1 0 5M13 3.5a7 7 0 0 1 0 9",
  silent: "M2 6h3l4-3v10l-4-3H2zM11 6l4 4M15 6l-4 4",
} as const;

export function Icon({ name }: { name: keyof typeof paths }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" aria-hidden="true"><path d={paths[name]} /></svg>
  );
}
