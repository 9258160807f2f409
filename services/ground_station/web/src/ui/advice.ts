// SPDX-License-Identifier: Apache-2.0
// What to do where an order was refused: one sentence for each reason of the gate and the station.
import { t } from "./words.ts";

const advices: [RegExp, () => string][] = [
  [/too late|older/, () => t("The link or a clock is slow: give it again.")],
  [/repeated/, () => t("It was taken already: nothing is to be done.")],
  [/phase/, () => t("It does not fit what the vehicle does now: see its card.")],
  [/somebody else|holds the lease/, () => t("Ask who has control to hand it over.")],
  [/future|ahead of/, () => t("This machine's clock is ahead: set it.")],
  [/no proof/, () => t("Give control back and take it again.")],
  [/written/, () => t("The vehicle's disk is full or broken: see its diagnostics.")],
  [/bounds/, () => t("Draw at least three corners around the vehicle, and let its ways not cross.")],
  [/place is outside/, () => t("Choose a place inside of the fence.")],
  [/nobody of that number/, () => t("That person is no longer seen: tap another one.")],
  [/framing|not safe/, () => t("Choose a distance and a height within the sliders.")],
  [/take the lease/, () => t("Take control first.")],
  [/nothing was heard/, () => t("The vehicle's safety gate is not running, or the link is down.")],
  [/did not answer|does not answer|silent/,
    () => t("Nobody knows whether it was obeyed: watch the vehicle, and give it again.")],
  [/token/, () => t("Enter the station's token under Control.")],
  [/control is not enabled|read-only/, () => t("Start the station with --enable-control.")],
];

/** "": none is known. */
export function adviceFor(reason: string): string {
  return advices.find(([pattern]) => pattern.test(reason))?.[1]() ?? "";
}
