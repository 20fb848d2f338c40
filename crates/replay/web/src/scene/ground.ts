// A grid below everything and the world's axes, with their unit.

import { Group } from "three";
import { niceCeil } from "../geometry";
import type { History } from "../history";
import type { Settings } from "../layers";
import { label } from "./label";
import { Segments } from "./lines";
import type { Context, Part } from "./part";

export interface Box {
  low: number[];
  high: number[];
}

/** The box of everything that the object and the robot do in a run. */
export function extent(history: History): Box {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const include = (p: ArrayLike<number>) => {
    for (let i = 0; i < 3; i++) {
      low[i] = Math.min(low[i], p[i]);
      high[i] = Math.max(high[i], p[i]);
    }
  };
  for (const step of history.steps) {
    step.features.forEach(include);
    include(step.pose.slice(3));
  }
  return { low, high };
}

export class GroundPart implements Part {
  readonly object = new Group();

  constructor({ theme, unit }: Context, box: Box) {
    const cell = cellOf(box);
    const [x0, x1] = [cells(box.low[0], cell, -1), cells(box.high[0], cell, 1)];
    const [y0, y1] = [cells(box.low[1], cell, -1), cells(box.high[1], cell, 1)];
    const z = box.low[2] - 0.3 * cell;
    const lines: [number[], number[]][] = [];
    for (let x = x0; x <= x1; x++) lines.push([[x * cell, y0 * cell, z], [x * cell, y1 * cell, z]]);
    for (let y = y0; y <= y1; y++) lines.push([[x0 * cell, y * cell, z], [x1 * cell, y * cell, z]]);
    const grid = new Segments(lines.length, { color: theme.grid, width: 1 });
    grid.set(lines);
    this.object.add(grid.object);

    const put = (text: string, x: number, y: number) => {
      const sprite = label(text, theme.muted, 0.015);
      sprite.position.set(x, y, z);
      this.object.add(sprite);
    };
    const every = (n: number) => (n > 12 ? 4 : n > 6 ? 2 : 1);
    const text = (k: number) => `${+(k * cell).toPrecision(6)}`;
    for (let x = x0; x <= x1; x += every(x1 - x0)) put(text(x), x * cell, (y0 - 0.45) * cell);
    for (let y = y0; y <= y1; y += every(y1 - y0)) put(text(y), (x1 + 0.45) * cell, y * cell);
    put("x / cm", ((x0 + x1) / 2) * cell, (y0 - 1.3) * cell);
    put("y / cm", (x1 + 1.5) * cell, ((y0 + y1) / 2) * cell);

    const corner = [x0 * cell, y0 * cell, z];
    const axes: [string, string, number[]][] = [
      ["x", "#D55E00", [1, 0, 0]],
      ["y", "#009E73", [0, 1, 0]],
      ["z", "#0072B2", [0, 0, 1]],
    ];
    for (const [name, color, way] of axes) {
      const end = corner.map((c, i) => c + way[i] * 2.5 * unit);
      const axis = new Segments(1, { color, width: 2.5 });
      axis.set([[corner, end]]);
      const sprite = label(name, color, 0.018);
      sprite.position.set(...(corner.map((c, i) => c + way[i] * 3 * unit) as [number, number, number]));
      this.object.add(axis.object, sprite);
    }
  }

  show(_index: number, settings: Settings): void {
    this.object.visible = settings.shows("grid");
  }
}

/** The width of the grid's cells, cm. */
function cellOf(box: Box): number {
  return niceCeil(Math.max(box.high[0] - box.low[0], box.high[1] - box.low[1]) / 8);
}

/** The grid line at or beyond `x`, downward (−1) or upward (1). */
function cells(x: number, cell: number, way: number): number {
  return way < 0 ? Math.floor(x / cell) : Math.ceil(x / cell);
}
