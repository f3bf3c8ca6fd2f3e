// Calls a function for elements when they become visible.

/**
 * Calls `seen(element)` once for each watched element when it comes within half a window height of the
 * window. Returns { watch(element), end() }.
 */
export function onceVisible(seen) {
  const observer = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting) continue;
        observer.unobserve(target);
        seen(target);
      }
    },
    { rootMargin: "50% 0px" },
  );
  return { watch: (element) => observer.observe(element), end: () => observer.disconnect() };
}
