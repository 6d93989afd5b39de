// What can be done, and by which keys.
import { element } from './dom.js';

// The page that is a single file has the licences in it.
function addressOfLicences() {
  const text = document.getElementById('licences')?.textContent;
  return text ? URL.createObjectURL(new Blob([text], { type: 'text/plain;charset=utf-8' })) : 'licences.txt';
}

export function helpDialog() {
  const keys = [['Ctrl S', 'save the netlist'], ['Space', 'play the run, or pause (outside the editor)'], ['P', 'present: question, schematic, plots and sliders on one screen, or back'], ['F', 'full screen'], ['E', 'the netlist, while presenting'],
    ['R', 'all numbers as the scene was opened'], ['T', 'freeze the curves'], ['M', 'measure with two cursors'], ['H', 'hold the axes'], ['← →', 'turn the slider that has the focus; move in a plot'],
    ['+ − 0', 'zoom in a plot, and show all'], ['Ctrl Z, Ctrl Y', 'undo, and do again'], ['Tab, ← →, Enter', 'in the schematic: go from part to part, and open its card'],
    ['Del', 'delete the element that has the focus in the schematic'], ['Ctrl Space', 'what can stand here, in the editor'], ['Esc, Tab', 'leave the editor'], ['G', 'the gallery (outside the editor)']];
  const dialog = element('dialog', { class: 'help', 'aria-labelledby': 'help-title' },
    element('div', { class: 'dialog-head' }, element('h2', { id: 'help-title' }, 'Help'), element('button', { type: 'button', onclick: () => dialog.close(), 'aria-label': 'Close' }, '✕')),
    element('p', {}, 'Choose a netlist in the gallery. Turn a slider, or change the text: schematic and plots follow. Click an element or a node of the schematic to see and change it. Draw shows the element types: choose one, and click the nodes where it goes; New begins an empty scene. Compare keeps the netlist as A and lets you change B. Freeze keeps the curves beside the next ones. A link carries the whole scene.'),
    element('dl', {}, keys.map(([key, does]) => [element('dt', {}, element('kbd', {}, key)), element('dd', {}, does)])),
    element('p', {}, element('a', { href: addressOfLicences(), target: '_blank' }, 'Licences'), ' of the software and the fonts in this page'));
  return dialog;
}
