// Pulling at the schematic: a mass that is dragged starts elsewhere, and a drive gets another value. The run follows at once.
import { calm } from './animation.js';

const steps = 2; // Steps of the slider of a drive for a pixel.
const whereNothingMoves = 1e-3; // m for a pixel
const turning = 0.02; // rad for a pixel
const inUnits = { m: [1e3, 'mm'], rad: [1, 'rad'] };

// Returns { move(px), end() }, which are called while the mouse or a finger drags the element with this name, or null if it cannot be pulled.
// `desk`: the playground.
export function pullOf(desk, name) {
  const { drawing, sliders } = desk;
  const element = drawing.scene?.elements.find((each) => each.name === name);
  if (!element || desk.course.isConcealing || drawing.isOn || !drawing.isNew || !drawing.read() || !drawing.netlist.element(name)) return null;
  if (element.type === 'mass' || element.type === 'inertia') return ofMass(desk, element.a);
  const numbers = drawing.netlist.numbersIn(drawing.netlist.element(name));
  const slider = sliders.all.find(({ from }) => numbers.has(from));
  if (!slider) return null;
  const place = slider.place();
  return {
    move(px) {
      sliders.held = slider;
      slider.slide(slider.valueAt(Math.min(slider.steps, Math.max(0, place + Math.round(steps * px)))));
    },
    end: () => (sliders.held = null),
  };
}

function ofMass({ drawing, animation, editor, view }, node) {
  const { data } = animation;
  const column = data?.column(`${node}.position`);
  const isGiven = drawing.netlist.root.at('simulate', 'start_from') || drawing.scene.elements.some(({ type, a }) => type === 'motion' && a === node);
  if (!column?.length || isGiven || !drawing.netlist.nodeNames.includes(node)) return null;
  const record = data.records[data.index.get(`${node}.position`)];
  const [factor, unit] = inUnits[record.unit];
  const start = column[0];
  // A position that is a parameter stays one: its value changes.
  const given = drawing.netlist.root.at('nodes', node, 'position')?.plain;
  const path = given && drawing.netlist.root.at('parameters', given) ? ['parameters', given] : ['nodes', node, 'position'];
  const { px } = animation.scale;
  const perPixel = record.unit === 'rad' ? turning : px > 0 ? 1 / px : whereNothingMoves;
  return {
    move(far) {
      if (!drawing.read()) return;
      animation.rewind();
      animation.held = px;
      const value = Number(((start + (far / view.shown) * perPixel) * factor).toPrecision(3));
      editor.replaceAll(drawing.netlist.set(path, JSON.stringify(`${value} ${unit}`)));
    },
    end() {
      animation.held = 0;
      if (!calm()) animation.start();
    },
  };
}
