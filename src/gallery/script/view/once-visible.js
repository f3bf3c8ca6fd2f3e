// What is drawn only when it comes into sight.

/**
 * Calls `seen(element)` once for each element watched, when it comes within a screen's half of the window.
 * Returns { watch(element), end() }.
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
