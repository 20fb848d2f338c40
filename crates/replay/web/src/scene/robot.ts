// The robot: where it is, where it believes itself, what it can see and what it sees.

import {
  CircleGeometry,
  ConeGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  SphereGeometry,
} from "three";
import { placement } from "../geometry";
import { type Step, stepAt } from "../history";
import type { Settings } from "../layers";
import { polyline, Segments } from "./lines";
import type { Context, Part } from "./part";

/** A cone along the body's x axis, with the body's axes x, y, z. */
function glyph(colour: string, unit: number, opacity?: number): Group {
  const group = new Group();
  const body = new ConeGeometry(0.36 * unit, 1.15 * unit, 24).rotateZ(-Math.PI / 2);
  const translucent = opacity !== undefined;
  const material = new MeshStandardMaterial({
    color: colour,
    roughness: 0.5,
    transparent: translucent,
    opacity: opacity ?? 1,
  });
  group.add(new Mesh(body, material));
  const axes: [string, number[]][] = [
    ["#D55E00", [2, 0, 0]],
    ["#009E73", [0, 1.4, 0]],
    ["#0072B2", [0, 0, 1.4]],
  ];
  for (const [color, end] of axes) {
    const tip = end.map((x) => x * unit);
    group.add(polyline([0, 0, 0, ...tip], { color, width: 2.5, opacity }));
  }
  return group;
}

/** The half-ball ahead that the sensor reaches: rim, ribs and a breath of fill. */
function reach(colour: string, range: number): Group {
  const group = new Group();
  const fill = new MeshBasicMaterial({
    color: colour,
    transparent: true,
    opacity: 0.04,
    side: DoubleSide,
    depthWrite: false,
  });
  const dome = new SphereGeometry(range, 40, 16, 0, 2 * Math.PI, 0, Math.PI / 2);
  const disc = new CircleGeometry(range, 48).rotateY(Math.PI / 2);
  for (const shape of [dome.rotateZ(-Math.PI / 2), disc]) {
    const mesh = new Mesh(shape, fill);
    mesh.renderOrder = 5;
    group.add(mesh);
  }
  const arc = (from: number, to: number, point: (a: number) => number[]) => {
    const points: number[] = [];
    for (let i = 0; i <= 48; i++) points.push(...point(from + ((to - from) * i) / 48));
    group.add(polyline(points.map((x) => x * range), { color: colour, width: 1.2, opacity: 0.5 }));
  };
  const { PI, cos, sin } = Math;
  arc(0, 2 * PI, (a) => [0, cos(a), sin(a)]);
  arc(-PI / 2, PI / 2, (a) => [cos(a), sin(a), 0]);
  arc(-PI / 2, PI / 2, (a) => [cos(a), 0, sin(a)]);
  return group;
}

export class RobotPart implements Part {
  readonly object = new Group();
  readonly #truth: Group;
  readonly #estimate: Group;
  readonly #reach: Group;
  readonly #spread: Mesh;
  readonly #sight: Segments;

  constructor(private readonly context: Context) {
    const { history, theme, colour, unit } = context;
    this.#truth = glyph(theme.ink, unit);
    this.#estimate = glyph(colour, unit, 0.6);
    this.#reach = reach(theme.name === "light" ? "#3b6ea5" : "#8ab6e6", history.sensor_max_cm);
    const shell = new MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.2 });
    shell.depthWrite = false;
    this.#spread = new Mesh(new SphereGeometry(1, 24, 16), shell);
    const style = { color: theme.seen, width: 1.6, opacity: 0.85 };
    this.#sight = new Segments(history.steps[0].features.length, style);
    this.object.add(this.#truth, this.#estimate, this.#reach, this.#spread, this.#sight.object);
  }

  /** Where the true robot is drawn, cm. */
  get position(): [number, number, number] {
    return this.#truth.position.toArray() as [number, number, number];
  }

  show(index: number, settings: Settings): void {
    const step = stepAt(this.context.history, index);
    for (const [group, pose] of this.#poses(step)) {
      const { position, rotation } = placement(pose);
      group.position.copy(position);
      group.quaternion.copy(rotation);
    }
    const [, , , x, y, z] = step.estimated_pose;
    const size = (sigma: number) => Math.max(settings.sigmas * sigma, 1e-6);
    this.#spread.position.set(x, y, z);
    this.#spread.scale.set(
      size(step.pose_sigma[3]),
      size(step.pose_sigma[4]),
      size(step.pose_sigma[5]),
    );
    const from = step.pose.slice(3);
    this.#sight.set(step.visible.map((i) => [from, step.features[i]]));
    this.#truth.visible = this.#estimate.visible = settings.shows("robot");
    this.#spread.visible = settings.shows("robot") && settings.shows("ellipsoids");
    this.#reach.visible = settings.shows("view");
    this.#sight.object.visible = settings.shows("sight") && step.visible.length > 0;
  }

  #poses(step: Step): [Group, Step["pose"]][] {
    return [
      [this.#truth, step.pose],
      [this.#reach, step.pose],
      [this.#estimate, step.estimated_pose],
    ];
  }
}
