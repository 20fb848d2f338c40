// Colours that colour-blind eyes can tell apart: Okabe and Ito's for methods, viridis for amounts.

import { Color } from "three";

import type { History } from "./history";

const METHODS: Record<string, string> = {
  predetermined: "#999999",
  local: "#D55E00",
  global: "#0072B2",
  combined: "#009E73",
};

/** The colour of a run's planner, the same everywhere in adslam: its own, or that of its name. */
export function methodColour(history: Pick<History, "planner" | "planner_look">): string {
  const own = history.planner_look?.colour.map((part) => part.toString(16).padStart(2, "0"));
  return own ? `#${own.join("")}` : (METHODS[history.planner] ?? "#CC79A7");
}

/** What a run's planner is called. */
export function methodLabel(history: Pick<History, "planner" | "planner_look">): string {
  return history.planner_look?.label ?? history.planner;
}

export interface Theme {
  name: "light" | "dark";
  background: string;
  ink: string;
  muted: string;
  grid: string;
  surface: string;
  /** Features in sight, and the lines to them. */
  seen: string;
  /** Viewpoints. */
  viewpoint: string;
}

export const LIGHT: Theme = {
  name: "light",
  background: "#f6f7f9",
  ink: "#16191d",
  muted: "#5c6670",
  grid: "#cdd3da",
  surface: "#d3a29b",
  seen: "#E69F00",
  viewpoint: "#8f3f73",
};

export const DARK: Theme = {
  name: "dark",
  background: "#14171b",
  ink: "#f0f2f4",
  muted: "#9aa5b1",
  grid: "#333a42",
  surface: "#b07f7a",
  seen: "#F0E442",
  viewpoint: "#e08fc4",
};

const VIRIDIS = [
  0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c, 0x22a884, 0x44bf70, 0x7ad151,
  0xbddf26, 0xfde725,
].map((hex) => new Color(hex));

/** viridis at 0 (dark violet) to 1 (yellow). */
export function viridis(at: number, out = new Color()): Color {
  const x = Math.min(Math.max(at, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(x), VIRIDIS.length - 2);
  return out.copy(VIRIDIS[low]).lerp(VIRIDIS[low + 1], x - low);
}

/** The scale of the legend, best on the left. */
export const VIRIDIS_CSS = `linear-gradient(to right, ${VIRIDIS.map((c) => `#${c.getHexString()}`)
  .reverse()
  .join(", ")})`;
