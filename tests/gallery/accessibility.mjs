// Tests the accessibility of the pages: names, keys, contrast, themes, motion, narrow screens, print, and
// unusual titles.

import assert from "node:assert/strict";

import { contrastOf, eventually, openGallery } from "./browser.mjs";
import { atlas, addTest, startAt, PHONE } from "./pages-support.mjs";
import { MARKED_TITLE, oddAtlas } from "./odd-atlas.mjs";

addTest(
  "7.1",
  "pages have landmarks, names, one heading and titles; the skip link leads past the masthead",
  startAt(atlas, "/"),
  async (g, page) => {
    for (const fragment of ["/", "/evans", "/evans/1"]) {
      await g.go(fragment);
      for (const role of ["banner", "main", "contentinfo"])
        assert.equal(await page.getByRole(role).count(), 1, `${role} at ${fragment}`);
      assert.equal(await page.locator("h1").count(), 1, `headings at ${fragment}`);
      const nameless = await page.evaluate(
        () =>
          [...document.querySelectorAll("a, button, input, select")].filter(
            (element) =>
              !(element.getAttribute("aria-label") || element.textContent.trim() || element.labels?.length),
          ).length,
      );
      assert.equal(nameless, 0, `controls without a name at ${fragment}`);
    }
    assert.match(await page.title(), /^Evans linkage, page 1 of 1 · An atlas of coupler curves$/);
    assert.equal(await page.locator('.site-nav [aria-current="page"]').innerText(), "Families");
    await page.reload();
    await page.waitForSelector("main > *");
    await page.locator(".skip").focus();
    const box = await page.locator(".skip").boundingBox();
    assert.ok(box.y >= 0, "it is seen when it has the focus");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => document.activeElement.id), "content");
  },
);

addTest(
  "7.1b",
  "captions of thumbnails are shown in full, and no tile covers another one",
  startAt(atlas, "/roberts?show=curves"),
  async (g, page) => {
    for (const fragment of ["/roberts?show=curves", "/find", "/find?sort=-length"]) {
      await g.go(fragment);
      const tiles = () =>
        page.locator(".window > li").evaluateAll((all) =>
          all.map((tile) => {
            const [frame, label] = [tile, tile.querySelector(".label")].map((one) =>
              one.getBoundingClientRect(),
            );
            return frame.bottom - label.bottom;
          }),
        );
      await eventually(async () => {
        const all = await tiles();
        return all.length > 5 && all.every((room) => room >= -0.5);
      }, `captions have room at ${fragment}`);
      const clipped = await page
        .locator(".window .label")
        .evaluateAll(
          (labels) => labels.filter((label) => label.scrollHeight > label.clientHeight + 1).length,
        );
      assert.equal(clipped, 0, fragment);
    }
    // The caption of this family has three lines.
    await g.go("/roberts?show=curves");
    await eventually(
      async () => (await page.locator(".window .label").first().boundingBox()).height > 45,
      "three lines are shown",
    );
  },
);

addTest(
  "7.2",
  "everything can be reached by Tab alone, with a visible focus and no trap",
  startAt(atlas, "/evans/1"),
  async (g, page) => {
    await page.locator(".skip").focus();
    const seen = ["Skip to content"];
    for (let k = 0; k < 80; k += 1) {
      await page.keyboard.press("Tab");
      const at = await page.evaluate(() => {
        const element = document.activeElement;
        if (element === document.body) return null;
        const { outlineStyle, outlineWidth } = getComputedStyle(element);
        const spot = element.querySelector(".link-area");
        return {
          what: element.className.baseVal ?? element.className,
          text: element.getAttribute("aria-label") ?? element.textContent.trim().slice(0, 40),
          seen:
            (outlineStyle !== "none" && parseFloat(outlineWidth) >= 1) ||
            (spot && getComputedStyle(spot).stroke !== "none"),
        };
      });
      if (at === null) break;
      assert.ok(at.seen, `the focus is not seen on “${at.text}”`);
      seen.push(at.text);
    }
    assert.ok(seen.length < 80, "Tab comes to an end");
    for (const name of ["Skip to content", "Families", "Theme", "All pages", "Zoom out", "Fit", "Zoom in"]) {
      assert.ok(
        seen.some((text) => text.startsWith(name)),
        `${name} is not among ${seen}`,
      );
    }
  },
);

addTest(
  "7.3",
  "the theme is that of the system or as chosen, and is remembered",
  null,
  async ({ browser }) => {
    const g = await openGallery(browser, atlas, "/", { colorScheme: "dark" });
    const { page } = g;
    const theme = () =>
      page.evaluate(() => [
        document.documentElement.dataset.theme,
        getComputedStyle(document.body).backgroundColor,
      ]);
    const dark = await theme();
    assert.equal(dark[0], "dark");
    await page.emulateMedia({ colorScheme: "light" });
    await eventually(async () => (await theme())[0] === "light", "it follows the system");
    await page.getByRole("combobox", { name: "Theme" }).selectOption("dark");
    assert.deepEqual(await theme(), dark);
    // The browser stores settings with a delay.
    const remembered = async () => {
      await page.reload();
      await page.waitForSelector("main > *");
      return (await theme())[0] === "dark";
    };
    await eventually(remembered, "it is remembered");
    assert.deepEqual(await theme(), dark);
    await page.waitForSelector(".families path");
    const ink = await page
      .locator(".families path")
      .first()
      .evaluate((path) => getComputedStyle(path).stroke);
    await page.getByRole("combobox", { name: "Theme" }).selectOption("light");
    assert.notEqual(
      await page
        .locator(".families path")
        .first()
        .evaluate((path) => getComputedStyle(path).stroke),
      ink,
      "thumbnails too",
    );
    await g.close();
    const shy = await openGallery(browser, atlas, "/", {
      before: (fresh) =>
        fresh.addInitScript(() => {
          Object.defineProperty(window, "localStorage", {
            get: () => {
              throw new Error("no storage from disk");
            },
          });
        }),
    });
    await shy.page.getByRole("combobox", { name: "Theme" }).selectOption("dark");
    assert.equal(await shy.page.evaluate(() => document.documentElement.dataset.theme), "dark");
    await shy.close();
  },
);

addTest("7.4", "text has the contrast of WCAG AA, light and dark", null, async ({ browser }) => {
  for (const colorScheme of ["light", "dark"]) {
    const g = await openGallery(browser, atlas, "/", { colorScheme });
    for (const fragment of ["/", "/evans", "/evans/1?curve=1.1.1"]) {
      await g.go(fragment);
      const texts = g.page.locator("h1, h2, h3, p, dt, dd, a, button, .tag, .label, .name, span");
      for (const element of await texts.filter({ hasText: /\S/, visible: true }).all()) {
        const isPassive = await element.evaluate(
          (node) => node.closest("[aria-disabled=true], :disabled, .skip, .visually-hidden") !== null,
        );
        if (isPassive) continue;
        const contrast = await contrastOf(element);
        assert.ok(
          contrast >= 4.5,
          `${contrast.toFixed(2)} of “${await element.innerText()}” at ${fragment}, ${colorScheme}`,
        );
      }
    }
    await g.close();
  }
});

addTest("7.5", "nothing is cut off at 360 pixels", startAt(atlas, "/", PHONE), async (g, page) => {
  for (const fragment of ["/", "/evans", "/evans/1?curve=1.1.1", "/watt?show=curves", "/evans-chart/1"]) {
    await g.go(fragment);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 360, `${wide} pixels wide at ${fragment}`);
  }
  await g.go("/evans/1");
  for (const button of await page.locator(".page-bar :is(button, a):visible").all()) {
    const { width, height } = await button.boundingBox();
    assert.ok(Math.min(width, height) >= 24, "it is large enough for a finger");
  }
});

addTest(
  "7.6",
  "nothing moves if reduced motion is preferred",
  startAt(atlas, "/evans/1", { reducedMotion: "reduce" }),
  async (g, page) => {
    const moving = await page.evaluate(
      () =>
        [...document.querySelectorAll("*")].filter((element) => {
          const { transitionDuration, animationName } = getComputedStyle(element);
          return (
            transitionDuration.split(",").some((time) => parseFloat(time) > 0) || animationName !== "none"
          );
        }).length,
    );
    assert.equal(moving, 0);
  },
);

addTest(
  "7.7",
  "in print there is only the page, and the contact sheet without its frame",
  startAt(atlas, "/evans/1", { colorScheme: "dark" }),
  async (g, page) => {
    await page.emulateMedia({ media: "print" });
    for (const hidden of [".masthead", ".footer", ".page-bar", ".page-panel"])
      assert.ok(!(await page.locator(hidden).isVisible()), hidden);
    assert.ok(await page.locator(".page-sheet img").isVisible());
    assert.equal(
      await page.evaluate(() => getComputedStyle(document.body).backgroundColor),
      "rgb(255, 255, 255)",
    );
    await g.go("/evans?show=curves");
    const pdf = await page.pdf({ format: "A4" });
    assert.ok(pdf.length > 1000);
  },
);

addTest(
  "7.7b",
  "the key ? lists the keys that work in the view, and they do",
  startAt(atlas, "/evans/curve/3.1.1", { reducedMotion: "reduce" }),
  async (g, page) => {
    const dialog = page.getByRole("dialog", { name: "Keys" });
    const listed = async () => {
      await page.keyboard.press("?");
      const text = await dialog.innerText();
      const close = dialog.getByRole("button", { name: "Close" });
      assert.ok(await close.evaluate((button) => button === document.activeElement));
      await page.keyboard.press("Escape");
      await eventually(async () => (await dialog.count()) === 0, "Escape closes it");
      return text;
    };
    const plate = await listed();
    assert.match(plate, /On the plate.*Space.*On a handle/s);
    assert.doesNotMatch(plate, /On the page|On the pad|undo/);
    const input = () => page.getByLabel("Input", { exact: true }).inputValue();
    await page.keyboard.press("ArrowRight");
    const before = await input();
    await page.keyboard.press("End");
    await eventually(async () => (await input()) !== before, "End works from anywhere");
    await page.keyboard.press("Home");
    await eventually(async () => parseFloat(await input()) === 0, "Home works from anywhere");
    // What is typed in a field is no command.
    await page.getByLabel("Input", { exact: true }).press("?");
    assert.equal(await dialog.count(), 0);
    await page.getByLabel("centrodes").check();
    await page.keyboard.press("?");
    assert.match(await dialog.innerText(), /Ctrl\+Z/);
    await page.keyboard.press("]");
    await dialog.getByRole("button", { name: "Close" }).click();
    assert.match(await g.fragment(), /^\/evans\/curve\/3.1.1/, "keys do not apply while it is open");
    await g.go("/evans/1");
    assert.match(await listed(), /On the page.*On a curve of the page/s);
    await g.go("/find");
    await page.locator(".results a").first().waitFor();
    assert.match(await listed(), /In curves.*pin or unpin/s);
    await g.go("/shape");
    assert.match(await listed(), /On the pad.*close the curve/s);
    await page.locator(".pad").focus();
    for (const key of ["Enter", "ArrowRight", "Enter", "Shift+ArrowDown", "Enter", "Shift+C"])
      await page.keyboard.press(key);
    assert.match(await page.locator(".pad .drawn").getAttribute("d"), /Z$/, "C closes the curve");
    await g.go("/");
    await page.getByRole("button", { name: "Keys" }).click();
    assert.match(await dialog.innerText(), /^Keys\s+In all views/);
  },
);

addTest(
  "7.7c",
  "forced colours keep the tracks of sliders and the mark of the current view",
  startAt(atlas, "/evans/curve/3.1.1", { reducedMotion: "reduce", forcedColors: "active" }),
  async (g, page) => {
    const borders = await page
      .locator(".site-nav a")
      .evaluateAll((links) => links.map((link) => getComputedStyle(link).borderBottomColor));
    assert.equal(new Set(borders.slice(1)).size, 1, `${borders}`);
    assert.ok(!borders.slice(1).includes(borders[0]), `${borders}`);
    // The slider is at the left: the track is what is drawn at the right.
    await page.locator(".scrub").focus();
    await page.keyboard.press("Home");
    const shot = (await page.locator(".scrub").screenshot()).toString("base64");
    const lines = await page.evaluate(async (data) => {
      const picture = new Image();
      picture.src = `data:image/png;base64,${data}`;
      await picture.decode();
      const context = document.createElement("canvas").getContext("2d");
      Object.assign(context.canvas, { width: picture.width, height: picture.height });
      context.drawImage(picture, 0, 0);
      const column = context.getImageData(Math.round(0.8 * picture.width), 4, 1, picture.height - 8).data;
      return new Set(Array.from({ length: column.length / 4 }, (_, k) => column[4 * k])).size;
    }, shot);
    assert.ok(lines > 1, "the track is seen");
  },
);

for (const viewport of [
  { width: 390, height: 844 },
  // 1440 × 900 at a zoom of 200 %.
  { width: 720, height: 450 },
])
  addTest(
    "7.7d",
    `the drawing stays in view while sliders move, at ${viewport.width} × ${viewport.height}`,
    startAt(atlas, "/evans/curve/3.1.1", { reducedMotion: "reduce", viewport }),
    async (g, page) => {
      const slider = page.locator(".parameter input[type=range]:visible").last();
      await slider.focus();
      await page.mouse.wheel(0, 60);
      const stage = await page.locator(".stage").boundingBox();
      assert.ok(stage.y >= 0 && stage.y + stage.height < 0.6 * viewport.height, JSON.stringify(stage));
      const isFree = () =>
        slider.evaluate((element) => {
          const { left, top, width, height } = element.getBoundingClientRect();
          return element === document.elementFromPoint(left + width / 2, top + height / 2);
        });
      await eventually(isFree, "the drawing does not cover the slider");
      const path = () => page.locator(".stage .dashes").first().getAttribute("d");
      const before = await path();
      await page.keyboard.press("ArrowRight");
      await eventually(async () => (await path()) !== before, "it is drawn again");
    },
  );

addTest(
  "7.7e",
  "in By shape the first answer is in view after drawing on a telephone",
  startAt(atlas, "/shape", { viewport: { width: 390, height: 844 } }),
  async (g, page) => {
    const pad = await page.locator(".pad").boundingBox();
    const at = (part) => [
      pad.x + pad.width * (0.5 + 0.4 * Math.cos(2 * Math.PI * part)),
      pad.y + pad.height * (0.5 + 0.2 * Math.sin(2 * Math.PI * part)),
    ];
    await page.mouse.move(...at(0));
    await page.mouse.down();
    for (let k = 1; k <= 30; k += 1) await page.mouse.move(...at(k / 30));
    await page.mouse.up();
    const label = page.locator(".matches .label b").first();
    await label.waitFor({ timeout: 30000 });
    const box = await label.boundingBox();
    assert.ok(box.y > pad.y + pad.height && box.y + box.height < 844, JSON.stringify(box));
  },
);

addTest("7.8", "titles with markup are shown as text", null, async ({ browser }) => {
  const odd = oddAtlas(atlas);
  try {
    const g = await openGallery(browser, odd.folder, "/");
    for (const [fragment, place] of [
      ["/", ".families .name"],
      ["/evans", "h1"],
      ["/evans/1", "h1"],
    ]) {
      await g.go(fragment);
      assert.equal(await g.page.locator(place).first().innerText(), MARKED_TITLE);
    }
    assert.ok((await g.page.title()).includes(MARKED_TITLE));
    assert.equal(await g.page.locator("main b:text-is('Evans'), main img[src=x]").count(), 0);
    assert.equal(
      await g.page.getByRole("link", { name: "atlas.pdf" }).getAttribute("href"),
      "atlas.pdf",
      "the book",
    );
    await g.close();
  } finally {
    odd.remove();
  }
});

addTest(
  "7.9",
  "the page has a strict policy and no inline styles",
  startAt(atlas, "/evans/1"),
  async (g, page) => {
    const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute("content");
    assert.match(policy, /default-src 'none'/);
    assert.doesNotMatch(policy.replace("'wasm-unsafe-eval'", ""), /unsafe/);
    const html = await page.content();
    assert.doesNotMatch(html.replace(/<script[\s\S]*?<\/script>/g, ""), /\son\w+="/);
  },
);

addTest(
  "7.10",
  "in the dark theme pages are inverted, or as printed if that is chosen",
  startAt(atlas, "/evans/1", { colorScheme: "dark" }),
  async (g, page) => {
    const filter = () => page.locator(".page-sheet img").evaluate((image) => getComputedStyle(image).filter);
    assert.match(await filter(), /invert/);
    await page.getByRole("button", { name: "Printed colours" }).click();
    assert.equal(await filter(), "none");
    await page.reload();
    await page.waitForSelector(".page-sheet img");
    assert.equal(await filter(), "none", "it is remembered");
    await page.getByRole("combobox", { name: "Theme" }).selectOption("light");
    assert.equal(
      await page.getByRole("button", { name: "Printed colours" }).count(),
      0,
      "of no use in the light",
    );
  },
);

addTest("7.11", "pages on dark paper are not inverted in the dark theme", null, async ({ browser }) => {
  const odd = oddAtlas(atlas);
  try {
    const g = await openGallery(browser, odd.folder, "/watt/1", { colorScheme: "dark" });
    const { page } = g;
    const of = (property) =>
      page.locator(".page-sheet img").evaluate((image, name) => getComputedStyle(image)[name], property);
    await page.waitForSelector(".page-sheet img");
    assert.equal(await of("filter"), "none");
    assert.equal(await page.getByRole("button", { name: "Printed colours" }).count(), 0, "of no use here");
    await page.getByRole("combobox", { name: "Theme" }).selectOption("light");
    assert.equal(await of("colorScheme"), "dark", "what comes forward is light on it");
    await page.getByRole("combobox", { name: "Theme" }).selectOption("dark");
    await g.go("/evans-chart/1");
    await page.waitForSelector(".page-sheet img");
    assert.match(await of("filter"), /invert/);
    await g.close();
  } finally {
    odd.remove();
  }
});
