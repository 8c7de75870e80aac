// People that are shown, and their colors: by what they do.
import { layouts } from "../parts/layouts";
import { type Hello, kFallen, kFollowing, kPanicked, kPresent, type World } from "./messages";

const { disaster: kHazard, absent: kAbsent, attacker: kAttacker } = layouts.agent_roles;

export const kColors = { walks: "#2f6fb3", panics: "#d1571b", follows: "#8a3fb0", fallen: "#1a1a1a", attacker: "#b3261e" };

export function isShown(hello: Hello, people: World["people"], index: number): boolean {
  const role = hello.roles[index];
  return role !== kHazard && role !== kAbsent && (people.flags[index]! & kPresent) !== 0;
}

export function colorOfPerson(hello: Hello, people: World["people"], index: number): string {
  const flags = people.flags[index]!;
  if (hello.roles[index] === kAttacker) return kColors.attacker;
  if (flags & kFallen) return kColors.fallen;
  if (flags & kFollowing) return kColors.follows;
  return flags & kPanicked ? kColors.panics : kColors.walks;
}
