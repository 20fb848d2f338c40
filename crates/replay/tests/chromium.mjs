// Headless Chromium over its debugging pipe: no packages, no ports, no network.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const FLAGS = [
  "--headless=new",
  "--no-sandbox",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-quic",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-first-run",
  "--no-default-browser-check",
  "--hide-scrollbars",
  "--force-device-scale-factor=1",
  "--remote-debugging-pipe",
];

/** What `promise` gives, or an error after so many seconds. */
function within(seconds, promise, what) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`${what} took more than ${seconds} s`)), 1000 * seconds);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

export class Browser {
  #process;
  #profile;
  #next = 1;
  #waiting = new Map();
  #listeners = [];
  #rest = "";
  #gone = null;

  constructor(executable, width = 1200, height = 750) {
    this.#profile = mkdtempSync(join(tmpdir(), "adslam-chromium-"));
    const flags = [...FLAGS, `--user-data-dir=${this.#profile}`, `--window-size=${width},${height}`];
    this.#process = spawn(executable, [...flags, "about:blank"], {
      stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"],
      // A process group of its own, so that close() finds all of it.
      detached: true,
    });
    this.#process.stdio[4].setEncoding("utf8").on("data", (chunk) => this.#read(chunk));
    this.#process.stdio[3].on("error", () => {});
    this.#process.on("error", (error) => this.#end(error));
    this.#process.on("exit", () => this.#end(new Error("Chromium has ended")));
  }

  /** Sends a command; the session is that of a page. */
  send(method, params = {}, sessionId = undefined) {
    if (this.#gone) return Promise.reject(this.#gone);
    const id = this.#next++;
    this.#process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    const answer = new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, method });
    });
    return within(60, answer, method);
  }

  on(listener) {
    this.#listeners.push(listener);
  }

  async open(width, height) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page(this, sessionId);
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await page.send(`${domain}.enable`);
    await page.resize(width, height);
    return page;
  }

  /** Ends the browser with all its processes, and removes its profile. */
  async close() {
    const over = () => this.#process.exitCode !== null || this.#process.signalCode !== null;
    const gone = over() || new Promise((resolve) => this.#process.once("exit", resolve));
    await within(5, this.send("Browser.close"), "closing").catch(() => {});
    try {
      process.kill(-this.#process.pid, "SIGKILL");
    } catch {
      // There is nobody left.
    }
    await gone;
    // The last of them may still be writing.
    for (let attempt = 0; attempt < 25; attempt++) {
      try {
        rmSync(this.#profile, { recursive: true, force: true });
        return;
      } catch {
        await new Promise((resolve) => setTimeout(resolve, 200));
      }
    }
  }

  #read(chunk) {
    const messages = (this.#rest + chunk).split("\0");
    this.#rest = messages.pop();
    for (const text of messages) {
      const message = JSON.parse(text);
      const waiting = this.#waiting.get(message.id);
      if (!waiting) {
        for (const listener of this.#listeners) listener(message);
        continue;
      }
      this.#waiting.delete(message.id);
      const { resolve, reject, method } = waiting;
      if (message.error) reject(new Error(`${method}: ${message.error.message}`));
      else resolve(message.result);
    }
  }

  #end(error) {
    this.#gone = error;
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }
}

export class Page {
  /** Errors of the console, exceptions, and requests to anything but the page's own file. */
  errors = [];
  #browser;
  #session;
  #loaded = [];

  constructor(browser, session) {
    this.#browser = browser;
    this.#session = session;
    browser.on(({ method, params, sessionId }) => {
      if (sessionId !== session) return;
      if (method === "Page.loadEventFired") for (const done of this.#loaded.splice(0)) done();
      if (method === "Runtime.exceptionThrown") {
        const { text, exception } = params.exceptionDetails;
        this.errors.push(`${text} ${exception?.description ?? ""}`);
      }
      if (method === "Runtime.consoleAPICalled" && ["error", "assert"].includes(params.type)) {
        this.errors.push(params.args.map((a) => a.value ?? a.description).join(" "));
      }
      if (method === "Log.entryAdded" && params.entry.level === "error") {
        this.errors.push(params.entry.text);
      }
      if (method === "Network.requestWillBeSent" && !/^(file|data|blob|about):/.test(params.request.url)) {
        this.errors.push(`asked for ${params.request.url}`);
      }
    });
  }

  send(method, params) {
    return this.#browser.send(method, params, this.#session);
  }

  async resize(width, height) {
    const metrics = { width, height, deviceScaleFactor: 1, mobile: false };
    await this.send("Emulation.setDeviceMetricsOverride", metrics);
  }

  async go(url) {
    // By way of an empty page: another fragment of the same page would not load it again.
    for (const next of ["about:blank", url]) {
      const loaded = new Promise((resolve) => this.#loaded.push(resolve));
      await this.send("Page.navigate", { url: next });
      await within(30, loaded, `loading ${next}`);
    }
    await this.frames(3);
  }

  /** The value of an expression in the page. */
  async evaluate(expression) {
    const options = { expression, awaitPromise: true, returnByValue: true };
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", options);
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }

  /** Waits until so many frames have been drawn. */
  async frames(count) {
    for (let i = 0; i < count; i++) {
      await this.evaluate("new Promise((done) => requestAnimationFrame(() => setTimeout(done)))");
    }
  }

  async key(key, code = key, text = undefined) {
    const event = { key, code, text };
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", ...event });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key, code });
    await this.frames(2);
  }

  async mouse(type, x, y, buttons = 0) {
    const button = type === "mouseMoved" ? "none" : "left";
    await this.send("Input.dispatchMouseEvent", { type, x, y, button, buttons, clickCount: 1 });
  }

  /** A PNG, in base64. */
  async screenshot() {
    await this.frames(2);
    return (await this.send("Page.captureScreenshot", { format: "png" })).data;
  }
}
