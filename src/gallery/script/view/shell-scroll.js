// How far down each address was read: whoever comes back finds it as it was left.

/**
 * The memory of a window's history: `leave()` notes how far down the present entry is and takes up the next, `arrive()`
 * goes where that one was left, or to the top of a new one, but for views that go to a goal of their own (`data-goal`).
 */
export function scrollMemory() {
  const depths = new Map();
  let [present, newest] = [null, 0];
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
      if (present !== null) depths.set(present, window.scrollY);
      present = entry();
    },
    arrive: () => {
      const depth = depths.get(present);
      if (depth !== undefined) window.scrollTo(0, depth);
      else if (!document.querySelector("main [data-goal]")) window.scrollTo(0, 0);
    },
  };
}
