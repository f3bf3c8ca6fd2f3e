// Drives Firefox by Marionette, its built-in protocol: JSON over a local socket, which needs neither a
// package nor another program. https://firefox-source-docs.mozilla.org/testing/marionette/Protocol.html

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

// The time limit for the browser to start and to answer, in milliseconds.
const PATIENCE = 60000;

/** The path of Firefox, from FIREFOX in the environment; null if there is none. */
export function firefoxPath() {
  const { FIREFOX } = process.env;
  return FIREFOX && existsSync(FIREFOX) ? FIREFOX : null;
}

/**
 * The preferences of the browser: any free port, no network, and downloads in one folder.
 */
const preferences = (saved) => ({
  "marionette.port": 0,
  "browser.download.dir": saved,
  "browser.download.folderList": 2,
  "browser.download.alwaysOpenPanel": false,
  "browser.shell.checkDefaultBrowser": false,
  "browser.startup.page": 0,
  "browser.aboutwelcome.enabled": false,
  "datareporting.policy.dataSubmissionEnabled": false,
  "toolkit.telemetry.reportingpolicy.firstRun": false,
  "app.update.enabled": false,
  "app.normandy.enabled": false,
  "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false,
});

/** Starts Firefox without a window, with a temporary profile. */
export async function startFirefox(program) {
  const home = mkdtempSync(join(tmpdir(), "gallery-firefox-"));
  const saved = join(home, "saved");
  const profile = join(home, "profile");
  for (const folder of [saved, profile]) mkdirSync(folder);
  const lines = Object.entries(preferences(saved)).map(
    ([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`,
  );
  writeFileSync(join(profile, "user.js"), lines.join(""));
  const flags = ["--headless", "--no-remote", "--marionette", "--remote-allow-system-access"];
  const child = spawn(program, [...flags, "--profile", profile], { stdio: "ignore" });
  const gone = new Promise((done) => {
    child.once("exit", done);
    child.once("error", done);
  });
  try {
    const firefox = new Firefox(child, gone, home, saved);
    await firefox.connects(join(profile, "MarionetteActivePort"));
    return firefox;
  } catch (error) {
    child.kill("SIGKILL");
    await gone;
    rmSync(home, { recursive: true, force: true });
    throw error;
  }
}

const paused = (time) =>
  new Promise((done) => {
    setTimeout(done, time);
  });

class Firefox {
  constructor(child, gone, home, saved) {
    Object.assign(this, { child, gone, home, saved });
    [this.last, this.waiting, this.received] = [0, new Map(), Buffer.alloc(0)];
  }

  async connects(portFile) {
    const until = Date.now() + PATIENCE;
    while (!existsSync(portFile) || !readFileSync(portFile, "utf8").trim()) {
      assert.ok(Date.now() < until && this.child.exitCode === null, "Firefox has not started");
      await paused(50);
    }
    this.socket = connect(Number(readFileSync(portFile, "utf8")), "127.0.0.1");
    this.socket.on("data", (bytes) => this.hears(bytes));
    this.socket.on("error", (error) => this.fails(error));
    this.socket.on("close", () => this.fails(new Error("Firefox has hung up")));
    await this.asks("WebDriver:NewSession", { capabilities: {} });
    await this.asks("WebDriver:SetTimeouts", { script: PATIENCE, pageLoad: PATIENCE });
  }

  /** Every message is its length in bytes, a colon, and JSON: [1, number of the question, error, answer]. */
  hears(bytes) {
    this.received = Buffer.concat([this.received, bytes]);
    for (;;) {
      const colon = this.received.indexOf(":");
      if (colon < 0) return;
      const end = colon + 1 + Number(this.received.subarray(0, colon));
      if (this.received.length < end) return;
      const message = JSON.parse(this.received.subarray(colon + 1, end).toString());
      this.received = this.received.subarray(end);
      if (!Array.isArray(message)) continue;
      const [, number, error, answer] = message;
      const { done, failed } = this.waiting.get(number);
      this.waiting.delete(number);
      if (error) failed(new Error(`${error.error}: ${error.message}`));
      else done(answer);
    }
  }

  fails(error) {
    for (const { failed } of this.waiting.values()) failed(error);
    this.waiting.clear();
  }

  asks(command, parameters = {}) {
    const number = (this.last += 1);
    const text = JSON.stringify([0, number, command, parameters]);
    return new Promise((done, failed) => {
      this.waiting.set(number, { done, failed });
      this.socket.write(`${Buffer.byteLength(text)}:${text}`);
    });
  }

  resize(width, height) {
    return this.asks("WebDriver:SetWindowRect", { width, height });
  }

  open(url) {
    return this.asks("WebDriver:Navigate", { url });
  }

  /**
   * Evaluates a function, which may return a promise, in the page; it is sent as text, with its arguments.
   */
  async evaluate(wanted, ...args) {
    const script = `return (${wanted})(...arguments);`;
    return (await this.asks("WebDriver:ExecuteScript", { script, args, sandbox: null })).value;
  }

  /** Moves the mouse through points [x, y] of the window, with its button down if `pressed`. */
  async mouse(places, pressed = false) {
    const moves = places.map(([x, y]) => ({
      type: "pointerMove",
      x: Math.round(x),
      y: Math.round(y),
      duration: 0,
    }));
    const actions = pressed
      ? [moves[0], { type: "pointerDown", button: 0 }, ...moves.slice(1), { type: "pointerUp", button: 0 }]
      : moves;
    const hand = { type: "pointer", id: "hand", parameters: { pointerType: "mouse" }, actions };
    await this.asks("WebDriver:PerformActions", { actions: [hand] });
  }

  async wheel([x, y], deltaY) {
    const roll = { type: "scroll", x: Math.round(x), y: Math.round(y), deltaX: 0, deltaY, duration: 0 };
    await this.asks("WebDriver:PerformActions", {
      actions: [{ type: "wheel", id: "wheel", actions: [roll] }],
    });
  }

  /** Presses keys, one after another; those without a letter by their names of WebDriver, "\uE014". */
  async keys(text) {
    const actions = [...text].flatMap((value) => [
      { type: "keyDown", value },
      { type: "keyUp", value },
    ]);
    await this.asks("WebDriver:PerformActions", { actions: [{ type: "key", id: "keys", actions }] });
  }

  /**
   * The messages of the browser's console from pages of a folder: errors, warnings, reports of the policy.
   */
  async complaints(home) {
    await this.asks("Marionette:SetContext", { value: "chrome" });
    const messages = await this.evaluate(() =>
      Services.console
        .getMessageArray()
        .filter((message) => message instanceof Ci.nsIScriptError)
        .map(({ sourceName, errorMessage }) => [sourceName, errorMessage]),
    );
    await this.asks("Marionette:SetContext", { value: "content" });
    return messages
      .filter(([source]) => source.startsWith(home))
      .map(([source, text]) => `${source}: ${text}`);
  }

  /** Waits until a function returns a truthy value in the page, and returns it. */
  async eventually(wanted, sentence, ...args) {
    const until = Date.now() + PATIENCE / 4;
    for (;;) {
      const value = await this.evaluate(wanted, ...args);
      if (value) return value;
      assert.ok(Date.now() < until, sentence);
      await paused(50);
    }
  }

  async close() {
    await Promise.race([
      this.asks("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => null),
      this.gone,
    ]);
    await Promise.race([this.gone, paused(PATIENCE / 6)]);
    this.child.kill("SIGKILL");
    await this.gone;
    rmSync(this.home, { recursive: true, force: true });
  }
}
