// The way so far, true and estimated.

import { Group } from "three";
import type { Line2 } from "three/addons/lines/Line2.js";
import type { Settings } from "../layers";
import { polyline, showSegments } from "./lines";
import type { Context, Part } from "./part";

export class PathsPart implements Part {
  readonly object = new Group();
  readonly #lines: Line2[];
  readonly #segments: number;

  constructor({ history, theme, colour }: Context) {
    const along = (pose: "pose" | "estimated_pose") =>
      history.steps.flatMap((step) => step[pose].slice(3));
    this.#segments = history.steps.length - 1;
    this.#lines = [
      polyline(along("pose"), { color: theme.ink, width: 2 }),
      polyline(along("estimated_pose"), { color: colour, width: 3 }),
    ];
    this.object.add(...this.#lines);
  }

  show(index: number, settings: Settings): void {
    this.object.visible = settings.shows("paths");
    for (const line of this.#lines) showSegments(line, Math.min(index, this.#segments));
  }
}
