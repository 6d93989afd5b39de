// Help: the actions and their keys.
import { element } from './dom.js';
import { t } from './messages.js';

// The page that is a single file has the licences in it.
function addressOfLicences() {
  const text = document.getElementById('licences')?.textContent;
  return text ? URL.createObjectURL(new Blob([text], { type: 'text/plain;charset=utf-8' })) : 'licences.txt';
}

export function helpDialog() {
  const keys = [['Ctrl S', t('save the netlist')], [t('Space'), t('play the run, or pause (outside the editor)')], ['P', t('present: question, schematic, plots and sliders on one screen, or back')], ['F', t('full screen')], ['E', t('the netlist, while presenting')],
    ['R', t('all numbers as the scene was opened')], ['T', t('freeze the curves')], ['M', t('measure with two cursors')], ['H', t('hold the axes')], ['← →', t('turn the slider that has the focus; move in a plot')],
    ['+ − 0', t('zoom in a plot, and show all')], ['Ctrl Z, Ctrl Y', t('undo, and do again')], [t('Tab, ← →, Enter'), t('in the schematic: go from part to part, and open its card')],
    [t('Del'), t('delete the element that has the focus in the schematic')], [t('Ctrl Space'), t('what can stand here, in the editor')], [t('Esc, Tab'), t('leave the editor')], [t('Drag'), t('pull at a mass or a drive of the schematic')], ['G', t('the gallery (outside the editor)')]];
  const dialog = element('dialog', { class: 'help', 'aria-labelledby': 'help-title' },
    element('div', { class: 'dialog-head' }, element('h2', { id: 'help-title' }, t('Help')), element('button', { type: 'button', onclick: () => dialog.close(), 'aria-label': t('Close') }, '✕')),
    element('p', {}, t('Choose a netlist in the gallery. Turn a slider, or change the text: schematic and plots follow. Click an element or a node of the schematic to see and change it. Draw shows the element types: choose one, and click the nodes where it goes; New begins an empty scene. Compare keeps the netlist as A and lets you change B. Freeze keeps the curves beside the next ones. A link carries the whole scene.')),
    element('dl', {}, keys.map(([key, does]) => [element('dt', {}, element('kbd', {}, key)), element('dd', {}, does)])),
    element('p', {}, element('a', { href: addressOfLicences(), target: '_blank' }, t('Licences')), t(' of the software and the fonts in this page')));
  return dialog;
}
