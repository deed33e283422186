/** Pointer, wheel, touch and keyboard on a tile view. */

/** Maximum movement of a press, in pixels, that still counts as a click. */
const STILL = 4;

/** @param {import("./tileview.js").TileView} view */
export function gestures(view) {
  const { surface } = view;
  const fingers = new Map();
  let press = null;
  let held = null;
  let pinch = null;

  const inside = (event) => {
    const box = surface.getBoundingClientRect();
    return [event.clientX - box.left - view.frame.left, event.clientY - box.top - view.frame.top];
  };
  const hover = (px) => {
    view.pointer = px;
    view.dispatchEvent(new CustomEvent("hover", { detail: px }));
  };

  surface.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    surface.setPointerCapture(event.pointerId);
    const px = inside(event);
    fingers.set(event.pointerId, px);
    if (view.stopMoving) {
      view.stopMoving();
      view.settled();
    }
    if (fingers.size === 2) {
      held?.cancel?.();
      [press, held] = [null, null];
      pinch = spread(fingers);
      pinch.along = axisAt(view, [pinch.x, pinch.y]);
      return;
    }
    press = { px, last: px, moved: false };
    held = view.grab?.(px, view.viewport.toPlane(...px), event.pointerType === "touch", event.shiftKey) ?? null;
  });

  surface.addEventListener("pointermove", (event) => {
    const px = inside(event);
    if (!fingers.has(event.pointerId)) {
      hover(px);
      surface.classList.toggle("grabs", Boolean(view.hand?.(px)));
      const along = axisAt(view, px);
      for (const axis of ["x", "y"]) surface.classList.toggle(`along-${axis}`, along === axis);
      return;
    }
    fingers.set(event.pointerId, px);
    if (pinch && fingers.size === 2) {
      const { along } = pinch;
      const now = { ...spread(fingers), along };
      view.viewport.pan(along === "y" ? 0 : now.x - pinch.x, along === "x" ? 0 : now.y - pinch.y);
      zoom(view, Math.log2(now.size / pinch.size), [now.x, now.y], along);
      pinch = now;
      return;
    }
    if (!press) return;
    if (Math.hypot(px[0] - press.px[0], px[1] - press.px[1]) > STILL) press.moved = true;
    if (held) held.move(px, view.viewport.toPlane(...px));
    else if (press.moved) {
      view.unmoved = false;
      view.viewport.pan(px[0] - press.last[0], px[1] - press.last[1]);
      surface.classList.add("pans");
      view.changed();
    }
    press.last = px;
  });

  const release = (event) => {
    if (!fingers.delete(event.pointerId)) return;
    surface.classList.remove("pans");
    if (pinch) {
      if (fingers.size < 2) pinch = null;
      view.settled();
      return;
    }
    if (!press) return;
    const px = inside(event);
    const { moved } = press;
    if (held) held.up(px, view.viewport.toPlane(...px), moved);
    else if (moved) view.settled();
    else if (event.type === "pointerup") pick(view, px);
    [press, held] = [null, null];
  };
  surface.addEventListener("pointerup", release);
  surface.addEventListener("pointercancel", release);
  surface.addEventListener("pointerleave", () => hover(null));

  surface.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 33 : event.deltaMode === 2 ? 400 : 1;
    const levels = -(event.deltaY * lines) / (event.ctrlKey ? 60 : 250);
    const px = inside(event);
    // not limited: a busy browser joins several turns of the wheel in one event
    zoom(view, levels, px, axisAt(view, px));
    clearTimeout(view.wheeled);
    view.wheeled = setTimeout(() => view.settled(), 250);
  }, { passive: false });

  surface.addEventListener("dblclick", (event) => {
    event.preventDefault();
    const px = inside(event);
    glide(view, event.shiftKey ? -1 : 1, px, axisAt(view, px));
  });

  for (const name of ["focus", "blur"]) surface.addEventListener(name, () => view.draw());
  surface.addEventListener("keydown", (event) => keyed(view, event));
}

/** The axis whose strip of numbers contains a pixel; null in the plane and in the corner. */
function axisAt(view, [px, py]) {
  const [left, below] = [px < 0, py > view.viewport.height];
  return left === below ? null : left ? "y" : "x";
}

/** The midpoint of two fingers and their distance. */
function spread(fingers) {
  const [[ax, ay], [bx, by]] = [...fingers.values()];
  return { x: (ax + bx) / 2, y: (ay + by) / 2, size: Math.max(10, Math.hypot(ax - bx, ay - by)) };
}

function pick(view, px) {
  if (view.viewport.holds(px)) view.dispatchEvent(new CustomEvent("pick", { detail: px }));
}

/** Zooms, and reports if the numeric limit is reached. Tiles are requested only at the end of the gesture. */
function zoom(view, levels, px, along = null) {
  view.unmoved = false;
  const limited = view.viewport.zoom(levels, px[0], px[1], view.density, along);
  view.dispatchEvent(new CustomEvent("limit", { detail: limited }));
  view.draw();
}

/** Zooms in a few frames, or at once if the user prefers reduced motion. */
export function glide(view, levels, px = [view.viewport.width / 2, view.viewport.height / 2], along = null) {
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const frames = still ? 1 : 9;
  let left = frames;
  let stopped = false;
  view.stopMoving?.();
  view.stopMoving = () => {
    stopped = true;
    view.stopMoving = null;
  };
  const step = () => {
    if (stopped) return;
    zoom(view, levels / frames, px, along);
    if (--left > 0) {
      requestAnimationFrame(step);
      return;
    }
    view.stopMoving = null;
    view.settled();
  };
  step();
}

const ARROWS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function keyed(view, event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const { viewport: v } = view;
  const centre = [v.width / 2, v.height / 2];
  const arrow = ARROWS[event.key];
  if (arrow) {
    const far = event.shiftKey ? 4 : 40;
    view.unmoved = false;
    v.pan(arrow[0] * far, arrow[1] * far);
    view.changed();
    for (const name of ["hover", "crosshair"]) view.dispatchEvent(new CustomEvent(name, { detail: centre }));
    clearTimeout(view.wheeled);
    view.wheeled = setTimeout(() => view.settled(), 300);
  } else if (event.key === "+" || event.key === "=") glide(view, 1);
  else if (event.key === "-" || event.key === "_") glide(view, -1);
  else if (["x", "y", "X", "Y"].includes(event.key)) glide(view, event.shiftKey ? -1 : 1, centre, event.key.toLowerCase());
  else if (event.key === "0" || event.key === "Home") view.dispatchEvent(new Event("home"));
  else if (event.key === "Enter" || event.key === " ") {
    if (view.entered) view.entered(centre);
    else pick(view, centre);
  } else return;
  event.preventDefault();
}
