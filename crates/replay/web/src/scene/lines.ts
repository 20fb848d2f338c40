// Lines of more than a pixel.

import type { ColorRepresentation } from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

export interface LineStyle {
  color: ColorRepresentation;
  /** px */
  width: number;
  opacity?: number;
  /** cm: dashes and gaps. */
  dash?: number;
}

function material(style: LineStyle): LineMaterial {
  return new LineMaterial({
    color: style.color,
    linewidth: style.width,
    opacity: style.opacity ?? 1,
    transparent: style.opacity !== undefined,
    depthWrite: style.opacity === undefined,
    dashed: style.dash !== undefined,
    dashSize: style.dash ?? 1,
    gapSize: style.dash ?? 1,
  });
}

/** A line through points, of which any number of the first can be shown. */
export function polyline(points: number[], style: LineStyle): Line2 {
  const geometry = new LineGeometry();
  // A line needs two points, even one that is never shown.
  geometry.setPositions(points.length >= 6 ? points : [0, 0, 0, 0, 0, 0]);
  const line = new Line2(geometry, material(style));
  if (style.dash !== undefined) line.computeLineDistances();
  line.frustumCulled = false;
  line.visible = points.length >= 6;
  return line;
}

/** Shows a line's first `count` segments. */
export function showSegments(line: Line2, count: number): void {
  line.geometry.instanceCount = count;
  line.visible = count > 0;
}

/** Separate segments whose ends move; room for `count`. */
export class Segments {
  readonly object: LineSegments2;
  readonly #ends: Float32Array;
  readonly #dashed: boolean;

  constructor(count: number, style: LineStyle) {
    this.#ends = new Float32Array(6 * Math.max(count, 1));
    this.#dashed = style.dash !== undefined;
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(this.#ends);
    this.object = new LineSegments2(geometry, material(style));
    this.object.frustumCulled = false;
  }

  /** Draws from p to q for each pair; those beyond the room are left out. */
  set(pairs: Iterable<[ArrayLike<number>, ArrayLike<number>]>): void {
    let count = 0;
    for (const [p, q] of pairs) {
      if (6 * count + 6 > this.#ends.length) break;
      for (let i = 0; i < 3; i++) {
        this.#ends[6 * count + i] = p[i];
        this.#ends[6 * count + 3 + i] = q[i];
      }
      count++;
    }
    this.object.visible = count > 0;
    if (count === 0) return;
    const geometry = this.object.geometry;
    const start = geometry.attributes.instanceStart as unknown as {
      data: { array: Float32Array; needsUpdate: boolean };
    };
    start.data.array.set(this.#ends);
    start.data.needsUpdate = true;
    geometry.instanceCount = count;
    if (this.#dashed) this.object.computeLineDistances();
  }
}
