// How far down each address was read, and where the focus was: whoever comes back finds it as it was left.

/**
 * The memory of a window's history: `leave()` notes how far down the present entry is and takes up the next,
 * `arrive()` goes where that one was left, or to the top of a new one, but for views that go to a goal of
 * their own (`data-goal`).
 */
export function scrollMemory() {
  const left = new Map();
  let [present, newest] = [null, 0];
  let settle = () => {};
  window.history.scrollRestoration = "manual";
  const entry = () => {
    const known = window.history.state?.entry;
    if (known !== undefined) return known;
    newest = Math.max(newest + 1, Date.now());
    window.history.replaceState({ entry: newest }, "");
    return newest;
  };
  return {
    leave: () => {
      settle();
      const link = document.activeElement?.closest("main a")?.getAttribute("href");
      if (present !== null) left.set(present, { depth: window.scrollY, link });
      present = entry();
    },
    arrive: () => {
      const known = left.get(present);
      if (known) settle = restoreScroll(known);
      else if (!document.querySelector("main [data-goal]")) window.scrollTo(0, 0);
    },
  };
}

/**
 * Goes as far down as an address was left, once its room has been filled so far; whoever moves meanwhile goes
 * a way of his own. Gives a function that ends it.
 */
function restoreScroll({ depth, link }) {
  const moves = ["wheel", "pointerdown", "keydown"];
  const growth = new ResizeObserver(() => goThere());
  const end = () => {
    growth.disconnect();
    moves.forEach((name) => window.removeEventListener(name, end));
  };
  const goThere = () => {
    window.scrollTo(0, depth);
    if (window.scrollY < depth - 1) return;
    end();
    restoreFocus(link);
  };
  moves.forEach((name) => window.addEventListener(name, end));
  growth.observe(document.querySelector("main"));
  goThere();
  return end;
}

/** Gives the focus back to a link of the room, when what comes into sight by scrolling is there. */
function restoreFocus(href) {
  if (!href) return;
  requestAnimationFrame(() =>
    requestAnimationFrame(() => {
      const links = [...document.querySelectorAll("main a")];
      links
        .find((link) => link.getAttribute("href") === href && link.tabIndex >= 0)
        ?.focus({ preventScroll: true });
    }),
  );
}
