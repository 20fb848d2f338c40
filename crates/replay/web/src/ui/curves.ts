// Which curves stand beside the scene.

import type { History, Step } from "../history";

export interface Curve {
  id: string;
  title: string;
  /** Of the vertical axis. */
  unit: string;
  /** Logarithmic axis. */
  log?: boolean;
  /** The axis starts at 0. */
  fromZero?: boolean;
  /** At a step; `next` is the step after it, which holds the decision taken here. */
  value: (step: Step, next?: Step) => number | null;
  /** The top of a band from 0, such as 3σ. */
  band?: (step: Step) => number;
  /** A second, thinner line. */
  second?: (step: Step) => number | null;
  /** Bounds that do not depend on the run. */
  bounds?: [number, number];
  /** The top of the axis at least. */
  top?: (histories: History[]) => number;
  /** What band, bounds or second line are. */
  note?: string;
}

/** The 2.5 % and 97.5 % quantiles of χ² with 6 degrees of freedom. */
const NEES_BOUNDS: [number, number] = [1.2373, 14.4494];

const threeSigma = (step: Step) => 3 * Math.hypot(...step.pose_sigma);

export const CURVES: Curve[] = [
  {
    id: "pose",
    title: "Pose error",
    unit: "rad, cm",
    fromZero: true,
    value: (step) => step.metrics.pose_error,
    band: threeSigma,
    second: (step) => step.metrics.drift_floor_cm ?? null,
    note: "band: ±3σ, thin: drift floor",
  },
  {
    id: "relative",
    title: "Relative pose error",
    unit: "rad, cm",
    fromZero: true,
    value: (step) => step.metrics.relative_pose_error,
    note: "to the object",
  },
  {
    id: "nees",
    title: "Pose NEES",
    unit: "1",
    fromZero: true,
    value: (step) => step.metrics.pose_nees,
    bounds: NEES_BOUNDS,
    note: "band: 95 % of χ²₆",
  },
  {
    id: "trace",
    title: "Covariance trace",
    unit: "rad² + cm²",
    fromZero: true,
    value: (step) => step.metrics.trace,
  },
  {
    id: "visible",
    title: "Features in sight",
    unit: "number",
    fromZero: true,
    value: (step) => step.visible.length,
    second: (step) => step.metrics.covered,
    top: (histories) => Math.max(...histories.map((run) => run.steps[0].features.length)),
    note: "thin: seen so far",
  },
  {
    id: "decision",
    title: "Decision time",
    unit: "ms, log",
    log: true,
    value: (_, next) => next?.decision?.milliseconds ?? null,
  },
];
