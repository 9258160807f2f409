// SPDX-License-Identifier: Apache-2.0
import { useEffect, useReducer, useState } from "preact/hooks";

import { isNarrow, narrowQuery } from "./layout.ts";
import type { Session } from "./session.ts";

/** Draws the component anew whenever the session says so: four times a second, and on input. */
export function useSession(session: Session): void {
  const [, redraw] = useReducer((n: number) => n + 1, 0);
  useEffect(() => session.onChange(() => redraw(undefined)), [session]);
}

/** A module loaded when it is first needed; null until then. */
export function useModule<T>(load: () => Promise<T>): T | null {
  const [module, setModule] = useState<T | null>(null);
  useEffect(() => {
    void load().then((loaded) => setModule(() => loaded));
  }, []);
  return module;
}


export function useNarrow(): boolean {
  const [narrow, setNarrow] = useState(isNarrow());
  useEffect(() => {
    const list = matchMedia(narrowQuery);
    const listen = (): void => setNarrow(list.matches);
    list.addEventListener("change", listen);
    return () => list.removeEventListener("change", listen);
  }, []);
  return narrow;
}
