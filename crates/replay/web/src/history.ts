// The runs in the page: what history.json holds (crates/experiment/src/run/history.rs).

export type Triple = [number, number, number];
export type Sextuple = [number, number, number, number, number, number];

export interface Decision {
  control: Sextuple;
  action: number | null;
  goal: number | null;
  admissible: number;
  safe: number;
  compromised: boolean;
  predicted_trace: number | null;
  milliseconds: number;
  /** Runs of scored actions: first, length, first, length, … */
  scored: number[];
  traces: number[];
}

export interface Metrics {
  pose_error: number;
  orientation_error_rad: number;
  position_error_cm: number;
  /** What any estimator's position error has to be, on average; absent in files of version 1. */
  drift_floor_cm?: number | null;
  relative_pose_error: number;
  feature_error_mean_cm: number;
  pose_nees: number | null;
  trace: number;
  covered: number;
  surface_distance_cm: number;
}

export interface Step {
  pose: Sextuple;
  estimated_pose: Sextuple;
  pose_sigma: Sextuple;
  features: Triple[];
  estimated_features: Triple[];
  feature_covariances: Sextuple[];
  visible: number[];
  /** Absent `turn`: the object does not turn as a whole. */
  object: { base_cm: Triple; turn?: number[]; r_d: number[]; amounts: number[] };
  decision: Decision | null;
  metrics: Metrics;
}

export interface DrawnMesh {
  rest_cm: Triple[];
  faces: Triple[];
  modes: Triple[][];
}

export interface History {
  scenario: string;
  planner: string;
  /** Absent where the name says it. */
  planner_look?: { label: string; colour: number[] };
  seed: number;
  sensor_min_cm: number;
  sensor_max_cm: number;
  clearance_cm: number;
  topology: Triple[];
  drawn: "features" | { mesh: DrawnMesh };
  actions: Sextuple[];
  viewpoints_cm: Triple[];
  steps: Step[];
}

/** The runs that the page holds, in order. */
export function readHistories(): History[] {
  const histories: History[] = [];
  for (let i = 0; ; i++) {
    const element = document.getElementById(`run-${i}`);
    if (!element?.textContent) return histories;
    histories.push(JSON.parse(element.textContent) as History);
    element.remove();
  }
}

/** Step `index` of a run; a run that is over stays at its last step. */
export function stepAt(history: History, index: number): Step {
  return history.steps[Math.min(index, history.steps.length - 1)];
}

/** The decision taken at step `index`, which leads to the next; none at the last step. */
export function decisionAt(history: History, index: number): Decision | null {
  return history.steps[index + 1]?.decision ?? null;
}

const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1];

/** The vertices of the drawn surface at a step, written one after the other into `out`. */
export function drawnVertices(history: History, step: Step, out: Float32Array): void {
  if (history.drawn === "features") {
    step.features.forEach((p, i) => out.set(p, 3 * i));
    return;
  }
  const { rest_cm, modes } = history.drawn.mesh;
  const { base_cm, r_d, amounts } = step.object;
  const turn = step.object.turn ?? IDENTITY;
  for (let v = 0; v < rest_cm.length; v++) {
    let x = 0;
    let y = 0;
    let z = 0;
    for (let k = 0; k < modes.length; k++) {
      const mode = modes[k][v];
      x += amounts[k] * mode[0];
      y += amounts[k] * mode[1];
      z += amounts[k] * mode[2];
    }
    const rest = rest_cm[v];
    const px = rest[0] + r_d[0] * x + r_d[1] * y + r_d[2] * z;
    const py = rest[1] + r_d[3] * x + r_d[4] * y + r_d[5] * z;
    const pz = rest[2] + r_d[6] * x + r_d[7] * y + r_d[8] * z;
    for (let i = 0; i < 3; i++) {
      out[3 * v + i] =
        base_cm[i] + turn[3 * i] * px + turn[3 * i + 1] * py + turn[3 * i + 2] * pz;
    }
  }
}

/** How many vertices the drawn surface has. */
export function drawnCount(history: History): number {
  return history.drawn === "features"
    ? history.steps[0].features.length
    : history.drawn.mesh.rest_cm.length;
}

/** The triangles of the drawn surface. */
export function drawnFaces(history: History): Triple[] {
  return history.drawn === "features" ? history.topology : history.drawn.mesh.faces;
}

/** Numbers from their runs: first, length, first, length, … */
export function expandRanges(runs: number[]): number[] {
  const numbers: number[] = [];
  for (let i = 0; i + 1 < runs.length; i += 2) {
    for (let k = 0; k < runs[i + 1]; k++) numbers.push(runs[i] + k);
  }
  return numbers;
}

/** The edges of triangles, each once, as pairs of corners. */
export function edgesOf(faces: Triple[]): [number, number][] {
  const edges = new Map<string, [number, number]>();
  for (const [a, b, c] of faces) {
    for (const [i, j] of [[a, b], [b, c], [c, a]]) {
      const edge: [number, number] = i < j ? [i, j] : [j, i];
      edges.set(edge.join(), edge);
    }
  }
  return [...edges.values()];
}
