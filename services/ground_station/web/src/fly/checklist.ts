// SPDX-License-Identifier: Apache-2.0
// Whether the vehicle may take off, in an operator's words; worked out from what is heard alone.
import type { SafetyState } from "../data/messages.ts";
import { batteryWord, Choice, explainPlan, Mode, PlanState, serviceWord, ServiceState, Track,
} from "../data/words.ts";
import { age_s, type State, type Vehicle } from "../store/state.ts";
import { gone_s, silent_s, stale_s } from "../store/watch.ts";
import { boundsOf, homeOf, toldBy } from "../store/derive.ts";
import { said, t } from "../ui/words.ts";

/** red: it must not fly so. note: worth knowing. */
export type Light = "green" | "red" | "note";
export interface Check { light: Light; what: string; todo: string }

const services = ["perception", "mapping", "prediction", "planning", "safety_gate"];
const battery_low = 0.3;
const blindness = ["", said("frozen"), said("dark"), said("covered")];

const green = (what: string): Check => ({ light: "green", what, todo: "" });
const red = (what: string, todo = ""): Check => ({ light: "red", what, todo });
const note = (what: string, todo = ""): Check => ({ light: "note", what, todo });

function checkLink(live: State, vehicle: Vehicle): Check {
  if (!live.link.open) return red(t("no connection to the station"), t("Is it running?"));
  return live.now_s - vehicle.heard_s > gone_s
    ? red(t("nothing is heard of the vehicle"), t("Check the radio link and foretrack onboard."))
    : green(t("the vehicle is heard"));
}

function checkServices(state: State, vehicle: Vehicle): Check {
  const bad = services.flatMap((name) => {
    const heard = vehicle.services.get(name);
    const mapIsGiven = name === "mapping" && !heard && vehicle.latest["map/local"] !== undefined;
    if (mapIsGiven) return [];
    if (!heard || age_s(state, heard) > silent_s) return [`${name}: ${t("silent")}`];
    if (heard.message.state === ServiceState.running) return [];
    return [`${name}: ${serviceWord(heard.message.state)}, ${heard.message.last_error}`];
  });
  return bad.length === 0 ? green(t("all services run well"))
    : red(bad.join("; "), t("See Diagnostics; foretrack doctor says more."));
}

function checkOdometry(state: State, { latest }: Vehicle): Check {
  return age_s(state, latest["odometry"]) >= 0 && age_s(state, latest["odometry"]) < stale_s
    ? green(t("the vehicle knows where it is"))
    : red(t("there is no odometry"), t("Is the state estimator running, and does it have GPS or " +
      "vision?"));
}

function checkBattery(state: State, { latest }: Vehicle): Check {
  const heard = latest["fmu/out/battery_status"];
  if (!heard || age_s(state, heard) > 10) return note(t("the battery is not known"));
  const { remaining, warning } = heard.message;
  const charge = t("battery {percent} %", { percent: Math.round(100 * remaining) });
  if (warning > 0) return red(`${charge}, ${batteryWord(warning)}`, t("Charge or change it."));
  return remaining < battery_low ? red(charge, t("Charge or change it.")) : green(charge);
}

function checkPerson(state: State, { latest }: Vehicle): Check {
  const choice = latest["target/choice"];
  if (choice && age_s(state, choice) < 2 && choice.message.state === Choice.waiting)
    return red(t("nobody was chosen to be followed"), t("Tap a person in the picture."));
  if (choice && age_s(state, choice) < 2 && choice.message.state === Choice.doubtful)
    return red(t("it is not sure who is followed"), t("Say which of them it is."));
  const target = latest["target/state"];
  return target && age_s(state, target) < stale_s && target.message.status === Track.tracking
    ? green(t("the person is seen"))
    : red(t("the person is not seen"), t("Let the camera look at them."));
}

function checkCamera(state: State, { latest }: Vehicle): Check {
  const bodies = latest["bodies"];
  if (!bodies || age_s(state, bodies) > stale_s) return red(t("perception tells of nobody around"));
  const fault = blindness[bodies.message.camera ?? 0] ?? "";
  return fault ? red(t("the camera is {fault}", { fault: t(fault) }), t("Clean or restart it."))
    : green(t("the camera sees"));
}

function checkMap({ latest }: Vehicle): Check {
  return latest["map/local"] || latest["map/points"] ? green(t("there is a map of what is around"))
    : red(t("there is no map"), t("Do depth images come? See Topics."));
}

function checkPlan(state: State, { latest }: Vehicle): Check {
  const heard = latest["plan/trajectory"];
  if (!heard || age_s(state, heard) > stale_s) return red(t("there is no plan"));
  const { status, reason } = heard.message;
  return status === PlanState.fresh || status === PlanState.kept
    ? green(t("there is a plan, and it is checked"))
    : red(t("there is no plan that can be flown: {why}", { why: explainPlan(reason) }));
}

/** Why the autopilot would refuse offboard mode, which the gate adds to its text. */
function hindrance(safety: SafetyState): string {
  return /would refuse: (.*)$/.exec(safety.text ?? "")?.[1] ?? "";
}

function checkAutopilot(state: State, { latest }: Vehicle): Check {
  const heard = latest["safety/state"];
  if (!heard || age_s(state, heard) > stale_s)
    return red(t("the safety gate is not heard"), t("Start foretrack onboard."));
  const { alarm } = heard.message;
  const why = hindrance(heard.message);
  if (alarm) return red(alarm, t("Find and end the other writer."));
  if (why) return red(t("the autopilot would refuse: {why}", { why }));
  if (heard.message.mode === Mode.silent && heard.message.armed)
    return note(t("somebody else flies the vehicle"));
  return green(t("the autopilot is ready"));
}

function checkDryRun({ latest }: Vehicle): Check[] {
  return latest["safety/state"]?.message.dry_run
    ? [note(t("dry run: nothing is sent to the autopilot"))] : [];
}

function checkBounds({ latest }: Vehicle): Check {
  const bounds = boundsOf(latest["safety/state"]?.message);
  if (!bounds) return note(t("fence: not known"), t("Draw and send it, to be sure."));
  return bounds.fence_m.length > 0 ? green(t("a fence is set"))
    : note(t("no fence is set"), t("Draw one on the map."));
}

function checkHome({ latest }: Vehicle): Check {
  return homeOf(latest["safety/state"]?.message) ? green(t("it knows where to return"))
    : note(t("return place: not known"), t("Set one below the map."));
}

/** Reactions of the gate that its diagnostic tells, by the names of its parameters. */
export function reactions(state: State, vehicle: Vehicle): [string, string][] {
  const words = [t("nothing"), t("it holds"), t("it returns"), t("it lands")];
  const told = (key: string): number => toldBy(state, vehicle, key);
  const of = (key: string): string =>
    words[told(key)] ?? t("as its parameter {key} says", { key });
  const link = told("link_timeout_s") === 0 ? words[0]! : of("link_reaction");
  const battery = told("battery_reserve") === 0 ? words[0]! : of("battery_reaction");
  return [
    [t("the person is lost"), t("it searches, and then hovers")],
    [t("plans cease"), t("it stops, hovers, and then hands over to the autopilot's failsafe")],
    [t("the station is not heard"), link],
    [t("the battery is at its reserve"), battery],
    [t("outside of the fence"), of("fence_reaction")],
    [t("outside of the altitudes"), of("altitude_reaction")],
  ];
}

/** `shown`: what is heard of the vehicle; `live`: of the station. */
export function checklist(shown: State, live: State, vehicle: Vehicle): Check[] {
  return [checkLink(live, vehicle), checkAutopilot(shown, vehicle), checkServices(shown, vehicle),
    checkOdometry(shown, vehicle), checkBattery(shown, vehicle), checkCamera(shown, vehicle),
    checkPerson(shown, vehicle), checkMap(vehicle), checkPlan(shown, vehicle),
    checkBounds(vehicle), checkHome(vehicle), ...checkDryRun(vehicle)];
}

export const isReady = (checks: Check[]): boolean => checks.every((c) => c.light !== "red");
