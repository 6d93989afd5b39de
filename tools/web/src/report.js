// A report: everything there is to see of one scene, or of several side by side.
import './style.css';
import './report.css';
import { element, schematicOf } from './dom.js';
import { PlotPanel } from './plot-panel.js';
import { SceneData } from './scene-data.js';
import { accuracyOf, claimsOf, elementsOf, energyOf, equationsOf, eventsOf, explanationOf, lessonOf, notesOf, sourcesOf, statisticsOf } from './sections.js';
import { followSystem } from './theme.js';
import { number, runTime } from './units.js';
import { differencesOf } from './differences.js';

followSystem();
const { title, version, scenes } = JSON.parse(document.getElementById('data').textContent);
const all = scenes.map(SceneData.from);
const letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZ';
const main = document.getElementById('report');

function section(heading, ...content) {
  const parts = content.flat().filter(Boolean);
  return parts.length ? element('section', {}, element('h3', {}, heading), parts) : null;
}

function plots(runs) {
  const host = element('div', { class: 'panel' });
  queueMicrotask(() => new PlotPanel(host).show(runs));
  return host;
}

function summary({ scene, done }) {
  const { domain, start, stop, element_count: elements, node_count: nodes, accuracy } = scene;
  const count = (n, one) => `${n} ${one}${n === 1 ? '' : 's'}`;
  return `${domain}, ${count(elements, 'element')}, ${count(nodes, 'node')}; ${start} s to ${stop} s to an accuracy of ${number(accuracy)}${done ? `, ${runTime(done.statistics)}` : ''}`;
}

function sceneOf(data, k) {
  const { scene } = data;
  const several = all.length > 1;
  return element('article', { class: 'scene' },
    several ? element('h2', {}, element('span', { class: 'letter' }, letters[k]), ` ${scene.title || scene.file}`) : null,
    element('p', { class: 'subtitle' }, element('code', {}, scene.file), ` – ${summary(data)}`),
    notesOf(data),
    section('The question', lessonOf(scene, false)),
    section('Schematic', schematicOf(scene)),
    several ? null : section('Plots', plots([{ label: '', data }])),
    section('Claims', claimsOf(data)),
    section('What is simulated, and why', explanationOf(data.explanation)),
    section('Elements', elementsOf(scene)),
    section('Equations', equationsOf(scene)),
    data.hasEnergy ? section('Energy account', energyOf(data)) : null,
    section('Events', eventsOf(data)),
    section('Accuracy and its price', accuracyOf(data)),
    data.done ? section('Statistics', statisticsOf(data)) : null,
    section('Netlist', sourcesOf(scene)));
}

main.append(
  element('header', { class: 'report-head' },
    element('h1', {}, title),
    element('p', { class: 'subtitle' }, `A report by rheonet ${version}. Drag in a plot to zoom, double-click to see all; point at a curve to read it.`)));
if (all.length > 1) {
  const runs = all.map((data, k) => ({ label: letters[k], data }));
  main.append(element('article', { class: 'comparison' },
    element('h2', {}, 'Side by side'),
    element('ul', { class: 'letters' }, all.map(({ scene }, k) => element('li', {}, element('span', { class: 'letter' }, letters[k]), ` ${scene.title || scene.file}`))),
    section('Plots', plots(runs)),
    runs.every(({ data }) => data.hasCurves) ? section('Differences', differencesOf(runs)) : null));
}
main.append(element('div', { class: all.length > 1 ? 'scenes several' : 'scenes' }, all.map(sceneOf)));
addEventListener('beforeprint', () => document.querySelectorAll('details.source-text').forEach((details) => (details.open = true)));
