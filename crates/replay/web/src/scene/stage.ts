// One run's 3-D view: the parts of its scene, its camera and what draws them.

import {
  AmbientLight,
  Color,
  DirectionalLight,
  type Object3D,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { methodColour, type Theme } from "../colours";
import { type History, stepAt } from "../history";
import type { Settings } from "../layers";
import { FeaturesPart } from "./features";
import { type Box, extent, GroundPart } from "./ground";
import { HullPart, SurfacePart } from "./object";
import { dispose, type Part } from "./part";
import { PathsPart } from "./paths";
import { CandidatesPart, ViewpointsPart } from "./plan";
import { RobotPart } from "./robot";

export type View = "iso" | "x" | "y" | "z" | "follow";

const WAYS: Record<Exclude<View, "follow">, [number, number, number]> = {
  iso: [-0.75, -1, 0.62],
  x: [-1, 0, 0.0001],
  y: [0, -1, 0.0001],
  z: [0, -0.0001, 1],
};

export class Stage {
  readonly controls: OrbitControls;
  readonly camera = new PerspectiveCamera(32, 1, 0.05, 2000);
  readonly box: Box;
  /** Called when the user turns the scene. */
  onTurn: () => void = () => {};
  robot!: RobotPart;
  candidates!: CandidatesPart;
  surface!: SurfacePart;
  features!: FeaturesPart;
  following = false;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  #parts: Part[] = [];
  #due = false;
  #yaw = 0;

  constructor(
    readonly history: History,
    readonly element: HTMLElement,
    theme: Theme,
  ) {
    this.#renderer = new WebGLRenderer({ antialias: true });
    this.#renderer.outputColorSpace = SRGBColorSpace;
    this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    element.prepend(this.#renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.box = extent(history);
    const sun = new DirectionalLight(0xffffff, 1.9);
    sun.position.set(0.4, 0.6, 1);
    this.camera.add(sun);
    this.#scene.add(this.camera, new AmbientLight(0xffffff, 1.5));
    this.controls = new OrbitControls(this.camera, this.#renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => this.element.classList.add("turning"));
    this.controls.addEventListener("end", () => this.element.classList.remove("turning"));
    this.controls.addEventListener("change", () => this.onTurn());
    this.dress(theme);
    new ResizeObserver(() => this.#resize()).observe(element);
  }

  /** Builds the scene in the colours of a theme. */
  dress(theme: Theme): void {
    for (const part of this.#parts) {
      this.#scene.remove(part.object);
      dispose(part.object);
    }
    const { history } = this;
    const unit = history.sensor_max_cm / 10;
    const context = { history, theme, unit, colour: methodColour(history) };
    this.robot = new RobotPart(context);
    this.candidates = new CandidatesPart(context);
    this.surface = new SurfacePart(context);
    this.features = new FeaturesPart(context);
    this.#parts = [
      new GroundPart(context, this.box),
      this.surface,
      new HullPart(context),
      this.features,
      new PathsPart(context),
      new ViewpointsPart(context),
      this.candidates,
      this.robot,
    ];
    this.#scene.add(...this.#parts.map((part): Object3D => part.object));
    this.#scene.background = new Color(theme.background);
  }

  show(index: number, settings: Settings): void {
    for (const part of this.#parts) part.show(index, settings);
    if (this.following) this.#follow(index);
    this.draw();
  }

  /** Looks from one of the sides, or goes behind the robot and stays there. */
  look(view: View, index: number): void {
    this.following = view === "follow";
    const { low, high } = this.box;
    if (view === "follow") {
      const pose = stepAt(this.history, index).pose;
      this.#yaw = pose[2];
      const away = 1.5 * this.history.sensor_max_cm;
      const behind = new Vector3(-0.9, 0.35, 0.5).applyAxisAngle(this.camera.up, this.#yaw);
      this.controls.target.set(pose[3], pose[4], pose[5]);
      this.camera.position.copy(this.controls.target).addScaledVector(behind, away);
    } else {
      const centre = low.map((x, i) => (x + high[i]) / 2) as [number, number, number];
      const way = new Vector3(...WAYS[view]).normalize();
      this.controls.target.set(...centre);
      this.camera.position.copy(this.controls.target).addScaledVector(way, this.#distance(way));
    }
    this.controls.update();
    this.draw();
  }

  /** How far away along `way` the whole box is in the picture. */
  #distance(way: Vector3): number {
    const { low, high } = this.box;
    const right = new Vector3().crossVectors(this.camera.up, way).normalize();
    const up = new Vector3().crossVectors(way, right);
    const tall = Math.tan((this.camera.fov * Math.PI) / 360);
    const wide = tall * this.camera.aspect;
    let far = 0;
    for (let corner = 0; corner < 8; corner++) {
      const [x, y, z] = low.map((from, i) => ((high[i] - from) / 2) * (corner & (1 << i) ? 1 : -1));
      const p = new Vector3(x, y, z);
      const needed = Math.max(Math.abs(p.dot(right)) / wide, Math.abs(p.dot(up)) / tall);
      far = Math.max(far, 1.12 * needed + p.dot(way));
    }
    return far;
  }

  /** Takes over the other's way of looking: relative to the robot while following it. */
  lookAs(other: Stage): void {
    const turn = this.following ? this.#yaw - other.#yaw : 0;
    const offset = other.camera.position.clone().sub(other.controls.target);
    if (!this.following) this.controls.target.copy(other.controls.target);
    offset.applyAxisAngle(this.camera.up, turn);
    this.camera.position.copy(this.controls.target).add(offset);
    this.camera.lookAt(this.controls.target);
    this.draw();
  }

  /** Moves the camera along with the robot and its heading. */
  #follow(index: number): void {
    const pose = stepAt(this.history, index).pose;
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, pose[2] - this.#yaw);
    this.#yaw = pose[2];
    this.controls.target.set(pose[3], pose[4], pose[5]);
    this.camera.position.copy(this.controls.target).add(offset);
    this.camera.lookAt(this.controls.target);
  }

  /** Draws at the next frame, once. */
  draw(): void {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      this.#renderer.render(this.#scene, this.camera);
    });
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.#renderer.setSize(width, height, false);
    this.#renderer.render(this.#scene, this.camera);
  }
}
