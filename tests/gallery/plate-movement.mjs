// Tests what a plate says of the motion: of a joint, at an input, against a load.

import assert from "node:assert/strict";

import { eventually, openGallery } from "./browser.mjs";
import { REDUCED_MOTION, assertNear, inputNow } from "./plate-support.mjs";

/** The numbers of a term of the panel. */
const numbersOf = async (page, term) => {
  const text = await page.locator(`.motion-numbers dt:text-is("${term}") + dd`).innerText();
  return text
    .replaceAll("−", "-")
    .match(/-?[\d.]+/g)
    .map(Number);
};

export const MOVEMENT = [
  [
    "3.22",
    "the numbers of a joint are those of closed forms, at an input that is typed and at a speed",
    async ({ browser, folder }) => {
      // A crank of length 1.
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1", REDUCED_MOTION);
      const { page } = plate;
      await page.getByLabel("Input", { exact: true }).fill("30,5");
      await page.keyboard.press("Enter");
      await eventually(async () => (await plate.fragment()).endsWith("?at=30.5"), "no address");
      await page.getByLabel("Joint", { exact: true }).selectOption("A");
      const angle = (30.5 * Math.PI) / 180;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      const near = async (term, wanted) =>
        (await numbersOf(page, term)).forEach((value, k) =>
          assertNear(value, wanted[k], 6e-4 * Math.abs(wanted[k]), term),
        );
      await near("Position", [cos, sin]);
      await near("Velocity", [-sin, cos, 1]);
      await near("Acceleration", [-cos, -sin, 1]);
      await page.getByLabel("Speed of the input, rpm").fill("120");
      const omega = 4 * Math.PI;
      await eventually(async () => (await numbersOf(page, "Velocity"))[2] > 2, "no speed");
      await near("Velocity", [-omega * sin, omega * cos, omega]);
      await near("Acceleration", [-omega * omega * cos, -omega * omega * sin, omega * omega]);
      await eventually(async () => /joint=A&rpm=120/.test(await plate.fragment()), "no address of it");
      await plate.close();
    },
  ],
  [
    "3.22",
    "a load gives the input torque, and what is no load is marked",
    async ({ browser, folder }) => {
      const address = "/evans/curve/1.1.1?joint=A&graph=torque&load=10%20on%20A%20at%20-90%20deg&at=60";
      const plate = await openGallery(browser, folder, address, REDUCED_MOTION);
      const { page } = plate;
      // The weight of 10 at a crank of length 1.
      assertNear((await numbersOf(page, "Input torque"))[0], 5, 1e-3, "the torque");
      assert.match(
        await page.locator(".motion-gauge .note").innerText(),
        /from −10\.00 to 10\.00; the greatest is 10\.00, at (0|180)\.00°/,
      );
      const line = await page.locator(".graph-line").getAttribute("d");
      await page.getByLabel("Load", { exact: true }).fill("ten on A");
      await page.keyboard.press("Enter");
      await eventually(
        () => page.getByLabel("Load", { exact: true }).evaluate((one) => one.matches("[aria-invalid=true]")),
        "unmarked",
      );
      assert.equal(await page.locator(".motion-numbers dt:text-is('Input torque')").count(), 0);
      await page.locator("h1").evaluate(() => document.activeElement.blur());
      await page.keyboard.press("Control+z");
      await eventually(
        async () => (await page.locator(".graph-line").getAttribute("d")) === line,
        "it is not undone",
      );
      await plate.close();
    },
  ],
  [
    "3.22",
    "a graph is saved as a table and as a drawing",
    async ({ browser, folder }) => {
      const plate = await openGallery(browser, folder, "/evans/curve/1.1.1?graph=mu", REDUCED_MOTION);
      const { page } = plate;
      const saved = async (format) => {
        const [download] = await Promise.all([
          page.waitForEvent("download"),
          page.getByRole("button", { name: format, exact: true }).click(),
        ]);
        const chunks = await (await download.createReadStream()).toArray();
        return [download.suggestedFilename(), Buffer.concat(chunks).toString()];
      };
      const [name, csv] = await saved("CSV");
      assert.equal(name, "evans-M-mu.csv");
      const [head, ...rows] = csv.trim().split("\n");
      assert.equal(head, "input,speed,acceleration,x,y,mu,advantage,torque");
      assert.ok(rows.length >= 400);
      for (const row of rows) {
        const [input, speed, , x, y, mu, advantage, torque] = row.split(",");
        assert.ok(
          [input, speed, x, y, mu].every((cell) => Number.isFinite(Number(cell))) && torque === "",
          row,
        );
        assertNear(Number(speed) * Number(advantage), 1, 1e-9, row);
      }
      const [, svg] = await saved("SVG");
      assert.match(svg, /^<svg xmlns=[^]*<path d="M[^]*Transmission angle of M, Evans linkage[^]*<\/svg>\n$/);
      await plate.close();
    },
  ],
];
