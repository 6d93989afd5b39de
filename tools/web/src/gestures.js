// Touch gestures on a plot: two fingers zoom, and one finger moves a zoomed plot. On an unzoomed plot one finger scrolls the page.

const range = ({ min, max }) => [min, max];

// chart: has `plot`, `lookAt({ x, y })` with ranges of its scales, and `isZoomed`.
export function listenToFingers(chart) {
  const { over } = chart.plot;
  let before = null;
  const seen = ({ touches }) => {
    const box = over.getBoundingClientRect();
    const points = [...touches].slice(0, 2).map(({ clientX, clientY }) => ({ x: clientX - box.left, y: clientY - box.top }));
    const mean = (key) => points.reduce((sum, point) => sum + point[key], 0) / points.length;
    return { count: points.length, x: mean('x'), y: mean('y'), spread: points.length > 1 ? Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y) : 0 };
  };
  over.addEventListener('touchstart', (event) => (before = seen(event)), { passive: true });
  over.addEventListener('touchend', (event) => (before = event.touches.length ? seen(event) : null), { passive: true });
  over.addEventListener('touchmove', (event) => {
    const now = seen(event);
    if (!before || now.count !== before.count || (now.count === 1 && !chart.isZoomed)) return;
    event.preventDefault();
    const zoom = now.count > 1 && now.spread > 0 ? before.spread / now.spread : 1;
    const { x, y } = chart.plot.scales;
    const from = before;
    // Keep the points under the fingers fixed.
    const next = ([min, max], was, is, length) => {
      const at = min + ((max - min) * was) / length;
      const span = (max - min) * zoom;
      const low = at - (span * is) / length;
      return [low, low + span];
    };
    const height = over.clientHeight;
    chart.lookAt({ x: next(range(x), from.x, now.x, over.clientWidth), y: next(range(y), height - from.y, height - now.y, height) });
    before = now;
  }, { passive: false });
}
