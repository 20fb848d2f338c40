// One small chart with a cursor: click or drag in it to go to a step.

import { methodColour } from "../colours";
import type { History } from "../history";
import type { Curve } from "./curves";
import { h, short } from "./dom";

const MARGIN = { left: 44, right: 10, top: 4, bottom: 17 };

interface Line {
  colour: string;
  dashed: boolean;
  values: (number | null)[];
  band: number[];
  second: (number | null)[];
}

export class Chart {
  readonly element: HTMLElement;
  readonly #canvas = h("canvas");
  readonly #readout = h("span", { class: "readout" });
  readonly #lines: Line[];
  readonly #range: [number, number];
  #index = 0;
  #width = 0;
  #height = 0;
  #ink = "";
  #faint = "";
  #muted = "";

  constructor(
    private readonly curve: Curve,
    private readonly histories: History[],
    private readonly count: number,
    seek: (index: number) => void,
  ) {
    const same = histories.length > 1 && histories[0].planner === histories[1].planner;
    this.#lines = histories.map((history, i) => ({
      colour: methodColour(history),
      dashed: same && i > 0,
      values: history.steps.map((step, n) => curve.value(step, history.steps[n + 1])),
      band: curve.band ? history.steps.map(curve.band) : [],
      second: curve.second ? history.steps.map(curve.second) : [],
    }));
    this.#range = this.#findRange();
    this.element = h(
      "figure",
      { class: "chart", "data-curve": curve.id },
      h(
        "figcaption",
        {},
        h("b", {}, curve.title),
        h("span", { class: "unit" }, ` / ${curve.unit}`),
        h("span", { class: "note" }, curve.note ?? ""),
        this.#readout,
      ),
      this.#canvas,
    );
    const go = (event: PointerEvent) => {
      const x = event.offsetX - MARGIN.left;
      const width = this.#canvas.clientWidth - MARGIN.left - MARGIN.right;
      seek((x / width) * (this.count - 1));
    };
    this.#canvas.addEventListener("pointerdown", (event) => {
      this.#canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    this.#canvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) go(event);
    });
    // Asking for the size when drawing would make the browser lay the page out each time.
    new ResizeObserver(() => {
      this.#width = this.#canvas.clientWidth;
      this.#height = this.#canvas.clientHeight;
      this.draw();
    }).observe(this.#canvas);
  }

  /** Takes the colours that the page has now. */
  dress(): void {
    const css = getComputedStyle(document.body);
    this.#ink = css.getPropertyValue("--ink");
    this.#faint = css.getPropertyValue("--line");
    this.#muted = css.getPropertyValue("--muted");
  }

  show(index: number): void {
    this.#index = index;
    const values = this.#lines.map((line) => {
      const value = line.values[Math.min(index, line.values.length - 1)];
      return h("i", { style: `--c:${line.colour}` }, short(value));
    });
    this.#readout.replaceChildren(...values);
    this.draw();
  }

  #findRange(): [number, number] {
    const all = this.#lines
      .flatMap((line) => [...line.values, ...line.second])
      .filter((x): x is number => x !== null && Number.isFinite(x));
    let low = Math.min(...all);
    let high = Math.max(...all);
    if (!Number.isFinite(low)) return [0, 1];
    // A band may be far above the line: it is let out of the picture rather than flatten it.
    const bands = this.#lines.flatMap((line) => line.band);
    if (bands.length > 0) high = Math.min(Math.max(high, ...bands), 4 * high);
    if (this.curve.bounds) high = Math.max(high, this.curve.bounds[1] * 1.1);
    if (this.curve.top) high = Math.max(high, this.curve.top(this.histories));
    if (this.curve.log) {
      low = Math.max(low, 1e-3);
      return [10 ** Math.floor(Math.log10(low)), 10 ** Math.ceil(Math.log10(Math.max(high, low * 2)))];
    }
    if (this.curve.fromZero) low = 0;
    return high > low ? [low, high * 1.04] : [low, low + 1];
  }

  draw(): void {
    const [width, height] = [this.#width, this.#height];
    const pen = this.#canvas.getContext("2d");
    if (!pen || width === 0 || height === 0) return;
    const ratio = window.devicePixelRatio;
    if (this.#canvas.width !== Math.round(width * ratio)) this.#canvas.width = width * ratio;
    if (this.#canvas.height !== Math.round(height * ratio)) this.#canvas.height = height * ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const ink = this.#ink;
    const frame = {
      x: (i: number) =>
        MARGIN.left + (i / Math.max(this.count - 1, 1)) * (width - MARGIN.left - MARGIN.right),
      y: (v: number) => {
        const [low, high] = this.#range;
        const at = this.curve.log
          ? Math.log(Math.max(v, low) / low) / Math.log(high / low)
          : (v - low) / (high - low);
        return height - MARGIN.bottom - at * (height - MARGIN.top - MARGIN.bottom);
      },
    };
    this.#axes(pen, frame, width, height);
    pen.save();
    pen.beginPath();
    pen.rect(MARGIN.left, 0, width - MARGIN.left - MARGIN.right, height - MARGIN.bottom);
    pen.clip();
    if (this.curve.bounds) {
      const [low, high] = this.curve.bounds.map(frame.y);
      pen.globalAlpha = 0.13;
      pen.fillStyle = ink;
      pen.fillRect(MARGIN.left, high, width, low - high);
      pen.globalAlpha = 1;
    }
    for (const line of this.#lines) this.#line(pen, frame, line);
    pen.restore();
    pen.strokeStyle = ink;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(frame.x(this.#index), MARGIN.top);
    pen.lineTo(frame.x(this.#index), height - MARGIN.bottom);
    pen.stroke();
    for (const line of this.#lines) {
      const value = line.values[Math.min(this.#index, line.values.length - 1)];
      if (value === null) continue;
      pen.fillStyle = line.colour;
      pen.beginPath();
      pen.arc(frame.x(Math.min(this.#index, line.values.length - 1)), frame.y(value), 3.2, 0, 7);
      pen.fill();
    }
  }

  #axes(
    pen: CanvasRenderingContext2D,
    frame: { x: (i: number) => number; y: (v: number) => number },
    width: number,
    height: number,
  ): void {
    pen.font = "10px system-ui, sans-serif";
    pen.strokeStyle = this.#faint;
    pen.fillStyle = this.#muted;
    pen.lineWidth = 1;
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    for (const v of ticks(this.#range, this.curve.log === true)) {
      const y = Math.round(frame.y(v)) + 0.5;
      pen.beginPath();
      pen.moveTo(MARGIN.left, y);
      pen.lineTo(width - MARGIN.right, y);
      pen.stroke();
      pen.fillText(short(v), MARGIN.left - 5, Math.max(y, 6));
    }
    pen.textBaseline = "alphabetic";
    pen.textAlign = "center";
    const every = [1, 2, 5, 10, 20, 25, 50, 100, 200, 500].find((n) => this.count / n <= 6) ?? 1000;
    for (let n = every; n <= this.count; n += every) {
      if (frame.x(n - 1) < width - 48) pen.fillText(`${n}`, frame.x(n - 1), height - 5);
    }
    pen.fillText("1", frame.x(0), height - 5);
    pen.textAlign = "right";
    pen.fillText("step", width - MARGIN.right + 4, height - 5);
  }

  #line(
    pen: CanvasRenderingContext2D,
    frame: { x: (i: number) => number; y: (v: number) => number },
    line: Line,
  ): void {
    if (line.band.length > 0) {
      pen.fillStyle = line.colour;
      pen.globalAlpha = 0.16;
      pen.beginPath();
      pen.moveTo(frame.x(0), frame.y(0));
      line.band.forEach((v, i) => pen.lineTo(frame.x(i), frame.y(v)));
      pen.lineTo(frame.x(line.band.length - 1), frame.y(0));
      pen.fill();
      pen.globalAlpha = 1;
    }
    const stroke = (values: (number | null)[], thickness: number, alpha: number) => {
      pen.strokeStyle = line.colour;
      pen.globalAlpha = alpha;
      pen.lineWidth = thickness;
      pen.lineJoin = "round";
      pen.setLineDash(line.dashed ? [5, 3] : []);
      pen.beginPath();
      let down = false;
      values.forEach((v, i) => {
        if (v === null) down = false;
        else {
          if (down) pen.lineTo(frame.x(i), frame.y(v));
          else pen.moveTo(frame.x(i), frame.y(v));
          down = true;
        }
      });
      pen.stroke();
      pen.setLineDash([]);
      pen.globalAlpha = 1;
    };
    stroke(line.second, 1, 0.75);
    stroke(line.values, 1.8, 1);
  }
}

/** A few round numbers within a range. */
function ticks([low, high]: [number, number], log: boolean): number[] {
  const found: number[] = [];
  if (log) {
    const decades = Math.round(Math.log10(high / low));
    const stride = Math.max(1, Math.ceil(decades / 3));
    for (let d = 0; d <= decades; d += stride) found.push(low * 10 ** d);
    return found;
  }
  const rough = (high - low) / 2.6;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((d) => d * power).find((s) => s >= rough) ?? rough;
  for (let v = Math.ceil(low / step) * step; v <= high; v += step) found.push(+v.toPrecision(12));
  return found;
}
