// The plate of a curve, in a browser: node tests/gallery/plate.mjs FOLDER
//
// FOLDER is that of an atlas with the families evans, watt, roberts, jansen, linear-actuator, inverted-slider-crank,
// geared-five-bar, hrones-nelson and cognates.

import assert from "node:assert/strict";

import { contrastOf, eventually, opened, runTests } from "./browser.mjs";

const [folder] = process.argv.slice(2);

const still = { reducedMotion: "reduce" };

/** The place of a joint on the screen, from the circle a hand takes hold of. */
const gripAt = (page, joint) => page.locator(`.grip[data-joint="${joint}"]:not(.crank-grip)`).evaluate((grip) => {
  const box = grip.ownerSVGElement.getBoundingClientRect();
  return [box.left + Number(grip.getAttribute("cx")), box.top + Number(grip.getAttribute("cy"))];
});

/** The input that the plate shows, in degrees or as a length. */
const inputNow = async (page) => Number((await page.locator(".input-now").textContent()).replace("−", "-").replace("°", ""));

const fieldOf = (page, name) => page.getByRole("spinbutton", { name: `Value of ${name}`, exact: true });

const sliderOf = (page, name) => page.locator(`.parameter:has(input[aria-label="Value of ${name}"]) input[type=range]`);

/** Fills a number in, as a hand does, and waits until the plate rests. */
async function changed(page, name, value) {
  await fieldOf(page, name).fill(String(value));
  await fieldOf(page, name).press("Tab");
  await page.waitForTimeout(300);
}

async function measureNow(page, name) {
  const row = page.locator("table.measures tr", { has: page.locator(".measure-name", { hasText: new RegExp(`^${name}$`) }) });
  return (await row.locator("td").allTextContents()).map((text) => text.replace("−", "-").replace("°", ""));
}

const near = (a, b, within, what) => assert.ok(Math.abs(a - b) <= within, `${what}: ${a}, not ${b} within ${within}`);

/** The angle of a crank on the screen, counter-clockwise from the x-axis, in degrees. */
async function crankAngle(page, pivot, pin) {
  const [px, py] = await gripAt(page, pin);
  const [ox, oy] = pivot;
  return (Math.atan2(oy - py, px - ox) * 180) / Math.PI;
}

/** The places of fixed pivots on the screen, from left to right. */
const pivotsOf = (page) => page.locator(".pivot:not(.inner)").evaluateAll((all) => all.map((circle) => {
  const box = circle.ownerSVGElement.getBoundingClientRect();
  return [box.left + Number(circle.getAttribute("cx")), box.top + Number(circle.getAttribute("cy"))];
}).sort((a, b) => a[0] - b[0]));

const tests = [
  ["3.1", "plays by itself, pauses and plays with the space bar", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1");
    const { page } = plate;
    const before = await inputNow(page);
    await eventually(async () => (await inputNow(page)) !== before, "nothing moves");
    await page.keyboard.press("Space");
    const paused = await inputNow(page);
    await page.waitForTimeout(200);
    assert.equal(await inputNow(page), paused);
    await page.keyboard.press("Space");
    await eventually(async () => (await inputNow(page)) !== paused, "it does not go on");
    await plate.close();
  }],
  ["3.1", "does not start by itself where motion is not wanted", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const before = await inputNow(plate.page);
    await plate.page.waitForTimeout(300);
    assert.equal(await inputNow(plate.page), before);
    assert.equal(await plate.page.getByRole("button", { name: "Play" }).count(), 1);
    await plate.close();
  }],
  ["3.1", "stops when it is left", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1");
    await plate.go("/");
    const frames = await plate.page.evaluate(() => new Promise((done) => {
      const ask = window.requestAnimationFrame;
      let asked = 0;
      window.requestAnimationFrame = (f) => { asked += 1; return ask.call(window, f); };
      setTimeout(() => { window.requestAnimationFrame = ask; done(asked); }, 300);
    }));
    assert.equal(frames, 0);
    await plate.close();
  }],
  ["3.2", "the slider scrubs, and its keys step by a degree and to limits", async ({ browser }) => {
    const plate = await opened(browser, folder, "/watt/curve/3.1.1", still);
    const { page } = plate;
    const scrub = page.getByRole("slider", { name: "Place on the circuit" });
    await scrub.focus();
    const before = await inputNow(page);
    await page.keyboard.press("ArrowRight");
    near(await inputNow(page), before + 1, 0.11, "a step of a degree");
    await page.keyboard.press("Shift+ArrowLeft");
    near(await inputNow(page), before - 9, 0.11, "ten degrees back");
    // Crank and coupler in line: 9 = 4 + 16 - 16 cos, so the limits are at arccos(11 / 16).
    const limit = (Math.acos(11 / 16) * 180) / Math.PI;
    await page.keyboard.press("End");
    near(await inputNow(page), limit, 0.051, "the limit");
    await page.keyboard.press("End");
    near(await inputNow(page), -limit, 0.051, "the other limit");
    assert.match(await scrub.getAttribute("aria-valuetext"), /^input −46\.6°$/);
    assert.match(await page.locator(".ends").textContent(), /−46\.6° to 46\.6°/);
    await plate.close();
  }],
  ["3.3", "the crank follows the hand turn after turn", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    const [pivot] = await pivotsOf(page);
    const at = await gripAt(page, 2);
    const radius = Math.hypot(at[0] - pivot[0], at[1] - pivot[1]);
    await page.mouse.move(...at);
    await page.mouse.down();
    const from = await crankAngle(page, pivot, 2);
    for (let deg = 0; deg <= 500; deg += 10) {
      const angle = ((from + deg) * Math.PI) / 180;
      await page.mouse.move(pivot[0] + 1.4 * radius * Math.cos(angle), pivot[1] - 1.4 * radius * Math.sin(angle));
    }
    await page.mouse.up();
    const wanted = (((from + 500) % 360) + 360) % 360;
    near(((await crankAngle(page, pivot, 2)) + 360) % 360, wanted, 1, "the crank's direction");
    near(await inputNow(page), wanted, 1, "the input");
    await plate.close();
  }],
  ["3.3", "a hand that goes beyond a limit comes back on the other branch", async ({ browser }) => {
    const plate = await opened(browser, folder, "/watt/curve/3.1.1", still);
    const { page } = plate;
    const [pivot] = await pivotsOf(page);
    await page.getByRole("slider", { name: "Place on the circuit" }).fill("0.2");
    const rocker = await gripAt(page, 3);
    const input = await inputNow(page);
    const at = await gripAt(page, 2);
    const radius = Math.hypot(at[0] - pivot[0], at[1] - pivot[1]);
    const to = async (deg) => {
      const angle = (deg * Math.PI) / 180;
      await page.mouse.move(pivot[0] + radius * Math.cos(angle), pivot[1] - radius * Math.sin(angle));
    };
    await page.mouse.move(...at);
    await page.mouse.down();
    for (let deg = input; deg <= 70; deg += 3) await to(deg);
    await to(70);
    near(await inputNow(page), 46.567, 0.06, "it stays at the limit");
    for (let deg = 70; deg >= input; deg -= 3) await to(deg);
    await to(input);
    await page.mouse.up();
    near(await inputNow(page), input, 0.3, "back at the input");
    const other = await gripAt(page, 3);
    assert.ok(Math.hypot(other[0] - rocker[0], other[1] - rocker[1]) > 20, "the rocker's pin is where it was");
    await plate.close();
  }],
  ["3.3", "any other joint can be dragged along its path", async ({ browser }) => {
    const plate = await opened(browser, folder, "/jansen/curve/1.1.1", still);
    const { page } = plate;
    const foot = await gripAt(page, 7);
    await page.mouse.move(...foot);
    await page.mouse.down();
    await page.mouse.move(foot[0] + 60, foot[1] - 2, { steps: 12 });
    await page.mouse.up();
    const after = await gripAt(page, 7);
    assert.ok(Math.abs(after[0] - foot[0]) > 30, `the foot went from ${foot} to ${after}`);
    await plate.close();
  }],
  ["3.3", "a finger drags joints, and two fingers zoom", async ({ browser }) => {
    const plate = await opened(browser, folder, "/chebyshev/curve/1.1.1", { ...still, hasTouch: true, viewport: { width: 360, height: 740 } });
    const { page } = plate;
    await page.locator(".stage").scrollIntoViewIfNeeded();
    const session = await page.context().newCDPSession(page);
    const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const joint = Number(await page.locator(".grip:not(.crank-grip)").first().getAttribute("data-joint"));
    const [x, y] = await gripAt(page, joint);
    const before = await inputNow(page);
    await touch("touchStart", [x, y]);
    for (let k = 1; k <= 8; k += 1) await touch("touchMove", [x + 4 * k, y + 2 * k]);
    await touch("touchEnd");
    assert.notEqual(await inputNow(page), before);
    const scale = async () => Number(/matrix\(([\d.]+)/.exec(await page.locator(".still > g").getAttribute("transform"))[1]);
    const fitted = await scale();
    const { left, top } = await page.locator(".stage").evaluate((stage) => stage.getBoundingClientRect().toJSON());
    await touch("touchStart", [left + 20, top + 20]);
    await touch("touchStart", [left + 20, top + 20], [left + 60, top + 20]);
    for (let k = 1; k <= 8; k += 1) await touch("touchMove", [left + 20, top + 20], [left + 60 + 8 * k, top + 20]);
    await touch("touchEnd");
    assert.ok((await scale()) > 1.5 * fitted, `the scale went from ${fitted} to ${await scale()}`);
    await plate.close();
  }],
  ["3.4", "both branches can be chosen, and the choice is in the address", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    const before = await gripAt(page, 3);
    await page.getByRole("radio", { name: /^2: a full turn, branch −1/ }).check();
    await eventually(async () => /circuit=2/.test(await plate.fragment()), "the address does not say it");
    const after = await gripAt(page, 3);
    assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) > 20);
    await plate.go("/evans/curve/1.1.1");
    assert.ok(await page.getByRole("radio", { name: /^1: .*this curve/ }).isChecked());
    await plate.close();
  }],
  ["3.5", "the dial shows the transmission angle and its range", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    await page.getByRole("slider", { name: "Place on the circuit" }).fill("0");
    // At input 0 the crank lies on the frame: coupler and rocker close a triangle with p - r = 1.
    const mu = (Math.acos((2 * 2.59 * 2.59 - 1) / (2 * 2.59 * 2.59)) * 180) / Math.PI;
    near(Number((await page.locator(".dial-now").textContent()).replace("°", "")), mu, 0.051, "the angle now");
    const told = await page.locator(".dial-gauge .note").textContent();
    assert.match(told, /least 22\.3°, greatest 70\.8°/);
    await plate.close();
  }],
  ["3.6", "the speed is told, with an arrow where it is wanted", async ({ browser }) => {
    const plate = await opened(browser, folder, "/scotch-yoke/curve/1.1.1", still);
    const { page } = plate;
    assert.ok((await page.locator(".speed-line").getAttribute("d")).length > 200);
    assert.equal(await page.locator(".moving .velocity").getAttribute("d"), "");
    await page.getByRole("checkbox", { name: "Velocity" }).check();
    assert.match(await page.locator(".moving .velocity").getAttribute("d"), /^M.*L/);
    assert.match(await plate.fragment(), /show=.*velocity/);
    await plate.close();
  }],
  ["3.7", "the straight portion is marked as long as the atlas has it", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    const [length, scale] = await page.evaluate(() => {
      const band = document.querySelector(".band");
      const numbers = band.getAttribute("d").match(/-?[\d.e-]+/g).map(Number);
      const n = numbers.length;
      const bar = document.querySelector(".scale-bar").getBBox().width / Number(document.querySelector(".scale-label").textContent);
      return [Math.hypot(numbers[n - 2] - numbers[0], numbers[n - 1] - numbers[1]), bar];
    });
    near(length, 1.71034663, 2e-3, "the band");
    assert.ok(scale > 10);
    await plate.close();
  }],
  ["3.8", "the cognates draw the same curve", async ({ browser }) => {
    const plate = await opened(browser, folder, "/cognates/curve/2.1.1", still);
    const { page } = plate;
    await page.getByRole("checkbox", { name: "Cognates" }).check();
    for (const part of ["0.1", "0.5", "0.85"]) {
      await page.getByRole("slider", { name: "Place on the circuit" }).fill(part);
      const apart = await page.evaluate(() => {
        const [x, y] = ["cx", "cy"].map((name) => Number(document.querySelector(".tracer").getAttribute(name)));
        return [...document.querySelectorAll(".cognate.first, .cognate.second")].map((path) => {
          // Crank, then the plate's third corner, then the rocker.
          const numbers = path.getAttribute("d").match(/-?[\d.]+/g).map(Number);
          return Math.hypot(numbers[8] - x, numbers[9] - y);
        });
      });
      assert.equal(apart.length, 2);
      for (const far of apart) assert.ok(far < 0.05, `the coupler points are ${far} px apart`);
    }
    assert.equal(await page.locator(".cognate-lengths tbody tr").count(), 3);
    await plate.close();
  }],
  ["3.9", "the centrodes touch at the pole, which is where crank and rocker meet", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1?show=names,centrodes,inflection", still);
    const { page } = plate;
    const found = await page.evaluate(() => {
      const number = (element, name) => Number(element.getAttribute(name));
      const at = (joint) => { const g = document.querySelector(`.grip[data-joint="${joint}"]:not(.crank-grip)`); return [number(g, "cx"), number(g, "cy")]; };
      const pivots = [...document.querySelectorAll(".pivot:not(.inner)")].map((c) => [number(c, "cx"), number(c, "cy")]);
      const [o, c] = pivots.sort((p, q) => p[0] - q[0]);
      const [a, b] = [at(2), at(3)];
      const cross = (u, v) => u[0] * v[1] - u[1] * v[0];
      const [u, v] = [[a[0] - o[0], a[1] - o[1]], [b[0] - c[0], b[1] - c[1]]];
      const t = cross([c[0] - o[0], c[1] - o[1]], v) / cross(u, v);
      const pole = document.querySelector(".pole").getAttribute("d").match(/-?[\d.]+/g).map(Number);
      return { meet: [o[0] + t * u[0], o[1] + t * u[1]], pole: [pole[0] + 6, pole[1]] };
    });
    near(found.pole[0], found.meet[0], 1.5, "the pole's x");
    near(found.pole[1], found.meet[1], 1.5, "the pole's y");
    for (const name of [".centrode.fixed", ".centrode.moving", ".inflection"]) {
      assert.ok((await page.locator(name).getAttribute("d")).length > 30, name);
    }
    await plate.close();
  }],
  ["3.10", "a slider recomputes curve and measures at once, and the address tells it", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    const before = await page.locator(".dashes").getAttribute("d");
    await sliderOf(page, "p").fill("2.5");
    await page.waitForTimeout(400);
    assert.notEqual(await page.locator(".dashes").getAttribute("d"), before);
    assert.match(await plate.fragment(), /\?p=2\.5$/);
    // Extreme transmission angles: frame less crank 1.5, frame and crank 3.5.
    const at = (d) => (Math.acos((2 * 2.59 * 2.59 - d * d) / (2 * 2.59 * 2.59)) * 180) / Math.PI;
    const [, least] = await measureNow(page, "mu min");
    const [, most] = await measureNow(page, "mu max");
    near(Number(least), at(1.5), 0.006, "mu min");
    near(Number(most), at(3.5), 0.006, "mu max");
    const [recorded, , change] = await measureNow(page, "mu min");
    near(Number(change), at(1.5) - Number(recorded), 0.02, "the change");
    await page.getByRole("button", { name: "As in the atlas" }).click();
    await eventually(async () => (await plate.fragment()) === "/evans/curve/1.1.1", "the address keeps the change");
    assert.equal(await page.locator(".dashes").getAttribute("d"), before);
    await plate.close();
  }],
  ["3.10", "an address with changed parameters opens so", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1?p=2.5&k=1.9", still);
    assert.equal(await fieldOf(plate.page, "p").inputValue(), "2.5");
    await plate.page.locator(".kept-parameters > summary").evaluate((summary) => { summary.parentElement.open = true; });
    assert.equal(await fieldOf(plate.page, "k").inputValue(), "1.9");
    assert.ok(await plate.page.locator(".changed-tag").isVisible());
    await plate.close();
  }],
  ["3.10", "what is derived follows, and can be set free", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    // The coupler point is k a along the coupler.
    await page.locator(".kept-parameters").evaluate((details) => { details.open = true; });
    assert.equal(await fieldOf(page, "M.along").inputValue(), "5.18");
    await changed(page, "k", 1.5);
    assert.equal(await fieldOf(page, "M.along").inputValue(), "3.885");
    await page.getByRole("button", { name: /Set free: M\.along/ }).click();
    await changed(page, "k", 2);
    assert.equal(await fieldOf(page, "M.along").inputValue(), "3.885");
    await plate.close();
  }],
  ["3.11", "a linkage that cannot be assembled says why, and the last one stays in view", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    await changed(page, "p", 9);
    const reason = page.locator(".stage .reason");
    assert.ok(await reason.isVisible());
    assert.match(await reason.textContent(), /^It cannot be assembled: .{10,}/);
    assert.ok(await page.getByRole("button", { name: "Play" }).isDisabled());
    assert.ok((await page.locator(".link").count()) > 2);
    await changed(page, "p", -1);
    assert.match(await reason.textContent(), /must be more than 0/);
    assert.equal(await fieldOf(page, "p").getAttribute("aria-invalid"), "true");
    await changed(page, "p", 2);
    assert.ok(await reason.isHidden());
    assert.ok(await page.getByRole("button", { name: "Play" }).isEnabled());
    await plate.close();
  }],
  ["3.11", "an address of a linkage that cannot be assembled says why, before the one of the atlas", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1?p=9", still);
    const { page } = plate;
    assert.match(await page.locator(".stage .reason").textContent(), /cannot be placed/);
    assert.ok((await page.locator(".dashes").getAttribute("d")).length > 100);
    await page.keyboard.press("+");
    await page.keyboard.press("ArrowRight");
    await page.getByRole("button", { name: /^Back: p/ }).click();
    await eventually(() => page.locator(".stage .reason").isHidden(), "it stays impossible");
    await plate.close();
  }],
  ["3.12", "all kinds of linkages open without a complaint, and move", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1");
    const families = await plate.page.evaluate(() => JSON.parse(document.getElementById("atlas").textContent).families.map(({ id }) => id));
    for (const id of families) {
      await plate.go(`/${id}/curve/1.1.1`);
      const { page } = plate;
      assert.ok(await page.locator(".tracer").count(), id);
      const before = await inputNow(page);
      await eventually(async () => (await inputNow(page)) !== before, `${id} does not move`);
      for (const box of await page.locator(".checks input:visible").all()) await box.check();
      await page.keyboard.press("End");
      await page.keyboard.press("ArrowRight");
      const strange = await page.locator(".stage").evaluate((stage) => [...stage.querySelectorAll("*")].some(
        (element) => ["d", "cx", "cy", "x", "y", "transform"].some((name) => /NaN|Infinity|undefined/.test(element.getAttribute(name) ?? "")),
      ));
      assert.ok(!strange, `${id} draws what is no number`);
    }
    await plate.close();
  }],
  ["3.13", "everything is told to screen readers, and the text stands out", async ({ browser }) => {
    for (const colorScheme of ["light", "dark"]) {
      const plate = await opened(browser, folder, "/watt/curve/1.1.1?p=1.9", { ...still, colorScheme });
      const { page } = plate;
      const scene = page.getByRole("img", { name: "The linkage on its curve" });
      const summary = await page.locator(`#${await scene.getAttribute("aria-describedby")}`).textContent();
      assert.match(summary, /four-bar/);
      assert.equal(await page.locator(".plate-split :is([aria-live], output)").count(), 0, "live values chatter");
      for (const text of [".plate .note", ".plate .lede", ".input-now", ".measures .definition", ".changed-tag", ".origin dt"]) {
        assert.ok((await contrastOf(page.locator(text).first())) >= 4.5, `${text} in ${colorScheme}`);
      }
      const unnamed = await page.locator(".plate :is(input, button, select)").evaluateAll((all) => all.filter(
        (control) => !(control.getAttribute("aria-label") || control.textContent.trim() || control.closest("label")),
      ).length);
      assert.equal(unnamed, 0);
      await plate.close();
    }
  }],
  ["3.14", "a narrow screen has the drawing first, and nothing sticks out", async ({ browser }) => {
    for (const width of [360, 768, 1400]) {
      const plate = await opened(browser, folder, "/hrones-nelson/curve/1.3.1?A=2.4", { ...still, viewport: { width, height: 800 } });
      const { page } = plate;
      const [stage, panel, wide] = await page.evaluate(() => [
        document.querySelector(".stage").getBoundingClientRect().top,
        document.querySelector(".plate-panel").getBoundingClientRect().top,
        document.documentElement.scrollWidth,
      ]);
      assert.ok(wide <= width, `${wide} px wide on ${width}`);
      assert.ok(width > 960 || stage < panel);
      await plate.close();
    }
  }],
  ["3.15", "pins, neighbours and the zoom work by keys", async ({ browser }) => {
    const plate = await opened(browser, folder, "/evans/curve/1.1.1", still);
    const { page } = plate;
    await page.keyboard.press("]");
    await eventually(async () => (await plate.fragment()) === "/evans/curve/2.1.1", "it stays");
    await page.waitForSelector("h1 .key:text('2.1.1')");
    const wide = () => page.locator(".still > g").getAttribute("transform");
    const fitted = await wide();
    await page.keyboard.press("+");
    assert.notEqual(await wide(), fitted);
    await page.keyboard.press("0");
    assert.equal(await wide(), fitted);
    await page.getByRole("button", { name: "Pin", exact: true }).press("Enter");
    assert.ok(await page.getByRole("button", { name: "Pinned" }).isVisible());
    await plate.close();
  }],
];

await runTests(tests);
