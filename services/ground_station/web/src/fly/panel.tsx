// SPDX-License-Identifier: Apache-2.0
// What an operator sets before and during a flight.
import { LeaseButton, NameField } from "../panels/commands.tsx";
import type { Session } from "../ui/session.ts";
import { BoundsPanel } from "./bounds.tsx";
import { ChecklistPanel } from "./checklist.tsx";
import { FramingPanel } from "./framing.tsx";

export function FlyPanel({ session }: { session: Session }) {
  return (
    <div class="fly">
      <div class="row control"><NameField session={session} /><LeaseButton session={session} /></div>
      <FramingPanel session={session} />
      <ChecklistPanel session={session} />
      <BoundsPanel session={session} />
    </div>
  );
}
