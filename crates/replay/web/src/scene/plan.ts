// What the planner is up to: its viewpoints and goal, and the actions that it scores.

import {
  Color,
  ConeGeometry,
  EdgesGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  OctahedronGeometry,
  Vector3,
} from "three";
import { viridis } from "../colours";
import { predict } from "../geometry";
import { decisionAt, expandRanges, type History, stepAt } from "../history";
import type { Settings } from "../layers";
import { label } from "./label";
import { polyline, Segments } from "./lines";
import type { Context, Part } from "./part";

export class ViewpointsPart implements Part {
  readonly object = new Group();
  readonly #marks: Mesh[] = [];
  readonly #heading: Segments;

  constructor(private readonly context: Context) {
    const { history, theme, unit } = context;
    const points = history.viewpoints_cm;
    points.forEach((p, i) => {
      const material = new MeshStandardMaterial({ color: theme.viewpoint, transparent: true });
      const mark = new Mesh(new OctahedronGeometry(0.3 * unit), material);
      mark.position.set(...p);
      this.#marks.push(mark);
      const number = label(`${i + 1}`, theme.viewpoint);
      number.position.set(p[0], p[1], p[2] + 0.7 * unit);
      this.object.add(mark, number);
    });
    const style = { color: theme.viewpoint, width: 1.4, dash: 0.35 * unit, opacity: 0.6 };
    this.object.add(polyline(points.flat(), style));
    this.#heading = new Segments(1, { color: theme.viewpoint, width: 2.2 });
    this.object.add(this.#heading.object);
  }

  show(index: number, settings: Settings): void {
    this.object.visible = settings.shows("viewpoints") && this.#marks.length > 0;
    if (!this.object.visible) return;
    const { history } = this.context;
    const goal = goalAt(history, index);
    this.#marks.forEach((mark, i) => {
      mark.scale.setScalar(i === goal ? 1.5 : 1);
      (mark.material as MeshStandardMaterial).opacity = goal !== null && i < goal ? 0.35 : 1;
    });
    const from = stepAt(history, index).pose.slice(3);
    this.#heading.set(goal === null ? [] : [[from, history.viewpoints_cm[goal]]]);
  }
}

/** The goal that the decision at a step heads for; the last one's at the end. */
export function goalAt(history: History, index: number): number | null {
  const decision = decisionAt(history, index) ?? stepAt(history, index).decision;
  return decision?.goal ?? null;
}

export class CandidatesPart implements Part {
  readonly object = new Group();
  readonly #arrows: InstancedMesh;
  readonly #chosen: Mesh;

  constructor(private readonly context: Context) {
    const { history, theme } = context;
    // Arrows that leave room between the places that the actions lead to.
    const farthest = Math.max(0, ...history.actions.map((a) => Math.hypot(a[3], a[4], a[5])));
    const unit = 0.22 * farthest || context.unit;
    const cone = new ConeGeometry(0.17 * unit, 0.8 * unit, 8).rotateZ(-Math.PI / 2);
    this.#arrows = new InstancedMesh(cone, new MeshBasicMaterial(), history.actions.length);
    this.#arrows.frustumCulled = false;
    const big = new ConeGeometry(0.34 * unit, 1.4 * unit, 10).rotateZ(-Math.PI / 2);
    this.#chosen = new Mesh(big, new MeshBasicMaterial());
    const rim = new LineBasicMaterial({ color: theme.ink });
    this.#chosen.add(new LineSegments(new EdgesGeometry(big, 30), rim));
    this.object.add(this.#arrows, this.#chosen);
  }

  /** How many arrows are drawn. */
  get count(): number {
    return this.object.visible ? this.#arrows.count : 0;
  }

  /** The transforms of the arrows, column by column. */
  get arrows(): number[] {
    return Array.from(this.#arrows.instanceMatrix.array).slice(0, 16 * this.count);
  }

  show(index: number, settings: Settings): void {
    const { history } = this.context;
    const decision = decisionAt(history, index);
    this.object.visible = settings.shows("candidates") && !!decision && decision.traces.length > 0;
    if (!this.object.visible || !decision) return;
    const from = stepAt(history, index).estimated_pose;
    const range = traceRange(decision.traces);
    const at = new Matrix4();
    const colour = new Color();
    const one = new Vector3(1, 1, 1);
    this.#chosen.visible = false;
    expandRanges(decision.scored).forEach((action, k) => {
      const { position, rotation } = predict(from, history.actions[action]);
      viridis(goodness(decision.traces[k], range), colour);
      this.#arrows.setMatrixAt(k, at.compose(position, rotation, one));
      this.#arrows.setColorAt(k, colour);
      if (action === decision.action) {
        this.#chosen.visible = true;
        this.#chosen.position.copy(position);
        this.#chosen.quaternion.copy(rotation);
        (this.#chosen.material as MeshBasicMaterial).color.copy(colour);
      }
    });
    this.#arrows.count = decision.traces.length;
    this.#arrows.instanceMatrix.needsUpdate = true;
    if (this.#arrows.instanceColor) this.#arrows.instanceColor.needsUpdate = true;
  }
}

/** The least and the greatest trace. */
export function traceRange(traces: number[]): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const trace of traces) {
    low = Math.min(low, trace);
    high = Math.max(high, trace);
  }
  return [low, high];
}

/** 1 for the smallest trace, 0 for the greatest. */
function goodness(trace: number, [low, high]: [number, number]): number {
  return high > low ? (high - trace) / (high - low) : 1;
}
