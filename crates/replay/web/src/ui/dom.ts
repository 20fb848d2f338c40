// Elements in a line.

type Child = Node | string;

/** An element with attributes and children; attributes that start with "on" are listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number | boolean | ((event: Event) => void)> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value !== false) element.setAttribute(name, value === true ? "" : `${value}`);
  }
  element.append(...children);
  return element;
}

const ICONS = {
  play: "M5 3v14l12-7z",
  pause: "M4 3h4v14H4zM12 3h4v14h-4z",
  back: "M15 3v14L5 10zM3 3h2v14H3z",
  forth: "M5 3v14l10-7zM15 3h2v14h-2z",
  start: "M17 3v14l-7-7zM10 3v14l-7-7zM2 3h1.6v14H2z",
  end: "M3 3v14l7-7zM10 3v14l7-7zM16.4 3H18v14h-1.6z",
};

export type Icon = keyof typeof ICONS;

/** Puts an icon into a button. */
export function icon(button: HTMLElement, name: Icon): void {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  button.replaceChildren(svg);
}

/** A number for people: about `digits` significant ones. */
export function short(x: number | null | undefined, digits = 3): string {
  if (x === null || x === undefined || !Number.isFinite(x)) return "–";
  if (x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5)) return (+x.toPrecision(digits)).toExponential();
  return `${+x.toPrecision(digits)}`;
}
